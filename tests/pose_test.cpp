// When two pairs of patches stand to each other alike: motions, mirrors, exchanged patches, and the
// bound of what is allowed to be off.
#include "pose/pose.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "form_factor/reference.hpp"

namespace {

using host::Loop;
using host::Vec3;

constexpr unsigned kSeed = 20260311;

class Pairs {
 public:
  explicit Pairs(unsigned seed) : random_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vec3 vec(double reach) {
    return {uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach)};
  }
  std::size_t below(std::size_t n) { return std::size_t(random_() % n); }

  /// A convex polygon of 3 to 6 corners about a point, facing along a direction.
  Loop polygon(const Vec3& centre, const Vec3& normal) {
    const Vec3 x = glm::normalize(
        glm::cross(normal, std::abs(normal.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
    const Vec3 y = glm::cross(normal, x);
    const std::size_t n = 3 + below(4);
    const double a = uniform(0.3, 1), b = uniform(0.3, 1);
    Loop loop;
    for (std::size_t k = 0; k < n; ++k) {
      const double angle = (double(k) + uniform(0, 0.7)) * 2 * M_PI / double(n);
      loop.push_back(centre + a * std::cos(angle) * x + b * std::sin(angle) * y);
    }
    return loop;
  }
  std::pair<Loop, Loop> pair() {
    const Vec3 to = glm::normalize(vec(1)) * uniform(1.5, 6);
    return {polygon(Vec3(0), glm::normalize(glm::normalize(to) + vec(0.5))),
            polygon(to, glm::normalize(-glm::normalize(to) + vec(0.5)))};
  }

 private:
  std::mt19937 random_;
};

/// The loop moved, in a mirror or not, from another first corner.
Loop moved(Loop loop, const glm::dquat& turn, const Vec3& shift, bool mirror, std::size_t first) {
  for (Vec3& x : loop) {
    if (mirror) x.z = -x.z;
    x = turn * x + shift;
  }
  if (mirror) std::reverse(loop.begin(), loop.end());
  std::rotate(loop.begin(), loop.begin() + std::ptrdiff_t(first % loop.size()), loop.end());
  return loop;
}

double f_of(const Loop& p, const Loop& q) { return host::reference_form_factor({p, {}}, {q, {}}); }

}  // namespace

TEST_CASE("a pair that is moved, mirrored, exchanged and numbered anew keeps its class") {
  MESSAGE("seed " << kSeed);
  Pairs pairs(kSeed);
  host::PoseClasses classes;
  for (std::size_t k = 0; k < 100; ++k) {
    const auto [p, q] = pairs.pair();
    const host::PoseOutline from = host::pose_outline(p), to = host::pose_outline(q);
    REQUIRE(classes.find(from, to).index == k);
    for (int copy = 0; copy < 8; ++copy) {
      const glm::dquat turn = glm::normalize(glm::dquat(
          pairs.uniform(-1, 1), pairs.uniform(-1, 1), pairs.uniform(-1, 1), pairs.uniform(-1, 1)));
      const Vec3 shift = pairs.vec(10);
      const bool mirror = copy & 1, swap = copy & 2;
      const auto a = host::pose_outline(moved(p, turn, shift, mirror, pairs.below(6))),
                 b = host::pose_outline(moved(q, turn, shift, mirror, pairs.below(6)));
      const auto found = swap ? classes.find(b, a) : classes.find(a, b);
      REQUIRE(found.index == k);
      CHECK(found.swapped == swap);
      CHECK(found.distance < 1e-12);
    }
  }
  CHECK(classes.size() == 100);
}

TEST_CASE("one corner off by more than the bound allows, and the pair has a class of its own") {
  Pairs pairs(kSeed + 1);
  for (int k = 0; k < 200; ++k) {
    auto [p, q] = pairs.pair();
    host::PoseClasses classes;
    const host::PoseOutline from = host::pose_outline(p), to = host::pose_outline(q);
    classes.find(from, to);
    const double allowed = host::pose_tolerance(from, to);
    // Within its plane, so that it stays a plane; away from the middle, so that no other choice of
    // corners undoes it.
    const std::size_t corner = pairs.below(q.size());
    const Vec3 outwards = glm::normalize(q[corner] - to.centre);
    q[corner] += 3 * allowed * outwards;
    CHECK(classes.find(from, host::pose_outline(q)).index == 1);
    q[corner] -= 2.9 * allowed * outwards;
    CHECK(classes.find(from, host::pose_outline(q)).index == 0);
  }
}

TEST_CASE(
    "turning one of two patches about their axis changes the class, turning it back does not") {
  // Squares face to face: every quarter turn is the same pose, an eighth is not.
  const auto square = [](double angle, double z, bool up) {
    Loop loop;
    for (int k = 0; k < 4; ++k) {
      const double t = angle + (up ? k : -k) * M_PI / 2;
      loop.push_back({std::cos(t), std::sin(t), z});
    }
    return host::pose_outline(loop);
  };
  host::PoseClasses classes;
  for (int k = 0; k < 32; ++k) {
    const auto found = classes.find(square(0.3, 0, true), square(0.3 + k * M_PI / 16, 2, false));
    const int away = std::min(k % 8, 8 - k % 8);  // a turn and its mirror image are one pose
    CHECK(found.index == std::size_t(away));
  }
  // Facing away is another pose than facing, whatever the distances of the corners.
  const std::size_t facing = classes.size();
  CHECK(classes.find(square(0.3, 0, true), square(0.3, 2, true)).index == facing);
}

TEST_CASE("what the bound says of F is never less than what F does") {
  MESSAGE("seed " << kSeed + 2);
  Pairs pairs(kSeed + 2);
  double closest = 0;
  for (int k = 0; k < 300; ++k) {
    const auto [p, q] = pairs.pair();
    // A thin pyramid's base: the patch moved as a whole and turned a little.
    const double size = std::pow(10.0, pairs.uniform(-5, -1));
    const glm::dquat turn =
        glm::angleAxis(size * pairs.uniform(-1, 1), glm::normalize(pairs.vec(1)));
    const Loop moved_q = moved(q, turn, pairs.vec(size), false, 0);
    double distance = 0;
    for (std::size_t c = 0; c < q.size(); ++c)
      distance = std::max(distance, glm::length(q[c] - moved_q[c]));
    const double bound =
        host::pose_difference(host::pose_outline(p), host::pose_outline(q), distance);
    const double off =
        std::max(std::abs(f_of(p, q) - f_of(p, moved_q)), std::abs(f_of(q, p) - f_of(moved_q, p)));
    CHECK(off <= bound);
    closest = std::max(closest, off / bound);
  }
  CHECK(closest > 1e-3);  // it is a bound on something
}
