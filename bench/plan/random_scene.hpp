// Scenes from seeds, as OBJ: what the constants of `urad plan` are fitted to and tested on.
#pragma once
#include <fmt/format.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <random>
#include <string>

namespace bench {

struct SceneText {
  std::string obj, mtl;
};

/// Four kinds in turn: a closed room whose patches match at the edges; one whose cuts differ from
/// wall to wall; one with a box hanging in it; one that is open to one side, with a plate in it.
class RandomScene {
 public:
  explicit RandomScene(unsigned seed) : random_(seed), kind_(seed % 4) {}

  SceneText make() {
    side_ = {uniform(0.6, 2), uniform(0.6, 2), uniform(0.6, 2)};
    patch_ = uniform(0.12, 0.3) * std::cbrt(side_.x * side_.y * side_.z);
    text_.obj = "mtllib room.mtl\n";
    for (int m = 0; m < 3; ++m) {
      text_.mtl += fmt::format("newmtl m{}\nKd {:.3f} {:.3f} {:.3f}\n", m, uniform(0.2, 0.85),
                               uniform(0.2, 0.85), uniform(0.2, 0.85));
    }
    text_.mtl += fmt::format("newmtl lamp\nKd 0 0 0\nKe {:.2f} {:.2f} {:.2f}\n", uniform(0.5, 2),
                             uniform(0.5, 2), uniform(0.5, 2));
    box({0, 0, 0}, side_, true, kind_ == 3);
    if (kind_ == 2)
      box(side_ * glm::dvec3(0.3, 0.3, 0.2), side_ * glm::dvec3(0.65, 0.7, 0.55), false, false);
    if (kind_ == 3) {
      const glm::dvec3 low = side_ * glm::dvec3(0.25, 0.3, 0.5), u(0.5 * side_.x, 0, 0),
                       v(0, 0.4 * side_.y, 0);
      quad(low, u, v, 0);
      quad(low, v, u, 1);
    }
    return text_;
  }

 private:
  double uniform(double low, double high) {
    return low + (high - low) * (double(random_()) + 0.5) / 0x1p32;
  }

  /// Lit side along u x v.
  void quad(const glm::dvec3& at, const glm::dvec3& u, const glm::dvec3& v, int material) {
    const auto cuts = [&](const glm::dvec3& edge) {
      return kind_ == 1 ? 2 + int(random_() % 7)
                        : std::max(1, int(std::lround(glm::length(edge) / patch_)));
    };
    const int nu = cuts(u), nv = cuts(v);
    for (const glm::dvec3& x : {at, at + u, at + u + v, at + v})
      text_.obj += fmt::format("v {:.9f} {:.9f} {:.9f}\n", x.x, x.y, x.z);
    text_.obj += fmt::format("# grid {} {}\nusemtl {}\nf -4 -3 -2 -1\n", nu, nv,
                             material < 0 ? std::string("lamp") : fmt::format("m{}", material));
  }

  /// Lit inside or outside. A room has its lamp in the ceiling and may lack the wall at y = 0.
  void box(const glm::dvec3& low, const glm::dvec3& high, bool inside, bool open) {
    const glm::dvec3 d = high - low, x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
    const auto face = [&](const glm::dvec3& at, const glm::dvec3& u, const glm::dvec3& v,
                          int material) {
      inside ? quad(at, u, v, material) : quad(at, v, u, material);
    };
    face(low, x, y, 0);
    face(low, y, z, 1);
    face(high, -z, -y, 2);
    if (!open) face(low, z, x, int(random_() % 3));
    face(high, -x, -z, int(random_() % 3));
    face(low + z, y, x, inside ? -1 : 1);
  }

  std::mt19937 random_;
  unsigned kind_;
  glm::dvec3 side_{1};
  double patch_ = 0.2;
  SceneText text_;
};

}  // namespace bench
