// The pairs of a seed: the same with every compiler, whatever order it takes arguments in.
#include "stress/hostile_pairs.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <map>

namespace {

constexpr std::uint64_t kSeed = 3;

/// FNV-1a of the coordinates in single precision: the last bits of a sine are the library's.
std::uint64_t digest(const host::PolygonPair& pair, std::uint64_t hash) {
  const auto add = [&](const host::Loop& loop) {
    for (const host::Vec3& x : loop)
      for (const double coordinate : {x.x, x.y, x.z})
        hash = (hash ^ std::bit_cast<std::uint32_t>(float(coordinate))) * 1099511628211u;
  };
  for (const host::Polygon* polygon : {&pair.p, &pair.q}) {
    add(polygon->outer);
    for (const host::Loop& hole : polygon->holes) add(hole);
  }
  return hash;
}

}  // namespace

TEST_CASE("the first 400 pairs of every hostile family are those of any compiler") {
  const std::map<std::string, std::uint64_t> expected{
      {"shared edge, 1e-6 to pi - 1e-6", 0x22610726cd3709e9},
      {"parallel, turned by 1e-16 to 1e-4", 0x10d325c515a2cb7d},
      {"slivers to 1e6", 0xbe5f83c7300619bf},
      {"gaps to 1e-9", 0x06c6c1173a08d257},
      {"sizes to 1e9", 0x3042d3e99412c336},
      {"concave quads", 0x01086a61ca1ae209},
      {"3 to 64 vertices", 0xa02dbab1a52ab6b7},
      {"holes", 0x72d25e3d1e178b91},
      {"collinear vertices", 0xe432f433854788b8},
      {"repeated vertices", 0xecb147def3719595},
      {"scales 1e-12 to 1e12", 0x6c07ef15762c2a57},
      {"1e6 sizes from the origin", 0xc183c63e426f7453},
  };
  const std::vector<host::HostileFamily> families = host::hostile_families();
  CHECK(families.size() == expected.size());
  for (const host::HostileFamily& family : families) {
    CAPTURE(family.name);
    std::uint64_t hash = 1469598103934665603u;
    for (std::uint64_t k = 0; k < 400; ++k) {
      host::Random random(kSeed, k);
      hash = digest(family.draw(random), hash);
    }
    CHECK(hash == expected.at(family.name));
  }
}
