// Boxes of ids in a common store: folded, turned, and read back through strides like the engine
// does.
#include "pose/pose_block.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <random>

namespace {

constexpr unsigned kSeed = 77001;

std::uint32_t& at(host::PoseBox& box, const std::array<std::size_t, 4>& k) {
  return box.id[((k[3] * box.size[2] + k[2]) * box.size[1] + k[1]) * box.size[0] + k[0]];
}

template <class Visit>
void each(const host::PoseBox& box, const Visit& visit) {
  std::array<std::size_t, 4> k{};
  for (k[3] = 0; k[3] < box.size[3]; ++k[3])
    for (k[2] = 0; k[2] < box.size[2]; ++k[2])
      for (k[1] = 0; k[1] < box.size[1]; ++k[1])
        for (k[0] = 0; k[0] < box.size[0]; ++k[0]) visit(k);
}

host::PoseBox random_box(std::mt19937& random, std::uint32_t ids) {
  host::PoseBox box;
  for (std::size_t& side : box.size) side = 1 + random() % 5;
  box.id.resize(box.count());
  for (std::uint32_t& id : box.id) id = std::uint32_t(random() % ids);
  return box;
}

/// Reads every entry as the engine would.
bool reads_back(host::PoseBox box, const host::PosePlace& place,
                const std::vector<std::uint32_t>& ids) {
  bool good = true;
  each(box, [&](const std::array<std::size_t, 4>& k) {
    std::int64_t there = place.first;
    for (std::size_t d = 0; d < 4; ++d) {
      std::int64_t position = std::int64_t(k[d]);
      if (d < 2) position -= place.centre[d];
      if (d < 2 && position < 0)
        position = place.mirror[d] == URAD_POSE_ABOUT_0 ? -position : ~position;
      there += position * place.stride[d];
    }
    good = good && there >= 0 && there < std::int64_t(ids.size()) &&
           ids[std::size_t(there)] == at(box, k);
  });
  return good;
}

/// Sides in another order, some backwards.
host::PoseBox turned(const host::PoseBox& box, std::array<std::size_t, 4> order,
                     unsigned backwards) {
  host::PoseBox result;
  for (std::size_t d = 0; d < 4; ++d) result.size[d] = box.size[order[d]];
  result.id.resize(box.count());
  host::PoseBox source = box;
  each(box, [&](const std::array<std::size_t, 4>& k) {
    std::array<std::size_t, 4> to{};
    for (std::size_t d = 0; d < 4; ++d)
      to[d] = backwards >> d & 1 ? box.size[order[d]] - 1 - k[order[d]] : k[order[d]];
    at(result, to) = at(source, k);
  });
  return result;
}

}  // namespace

TEST_CASE("every box is read back from the store, folded or not, found turned or appended") {
  MESSAGE("seed " << kSeed);
  std::mt19937 random(kSeed);
  host::PoseStore store;
  for (int k = 0; k < 400; ++k) {
    const host::PoseBox box = random_box(random, k % 4 ? 100 : 2);  // two ids: mirrors by chance
    const host::PosePlace place = store.add(box);
    CHECK(reads_back(box, place, store.ids()));
  }
}

TEST_CASE("a box that comes again, turned or backwards, takes no room") {
  std::mt19937 random(kSeed + 1);
  host::PoseStore store;
  for (int k = 0; k < 60; ++k) {
    const host::PoseBox box = random_box(random, 1000);
    store.add(box);
    const std::size_t held = store.ids().size();
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    std::shuffle(order.begin(), order.end(), random);
    const host::PoseBox again = turned(box, order, unsigned(random() % 16));
    CHECK(reads_back(again, store.add(again), store.ids()));
    CHECK(store.ids().size() == held);
  }
}

TEST_CASE("sides that mirror themselves are held once, about a place or between two") {
  for (const bool between : {false, true}) {
    host::PoseBox box;
    box.size[0] = between ? 10 : 11;
    box.size[1] = 3;
    for (std::uint32_t y = 0; y < 3; ++y)
      for (std::uint32_t x = 0; x < box.size[0]; ++x)
        box.id.push_back(10 * y + std::min(x, std::uint32_t(box.size[0]) - 1 - x));
    host::PoseStore store;
    const host::PosePlace place = store.add(box);
    CHECK(place.mirror[0] == (between ? URAD_POSE_ABOUT_HALF : URAD_POSE_ABOUT_0));
    CHECK(place.mirror[1] == URAD_POSE_PLAIN);
    CHECK(store.ids().size() == (between ? 15u : 18u));
    CHECK(reads_back(box, place, store.ids()));
  }
}
