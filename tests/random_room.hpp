// A closed box as OBJ text: random sides, cuts, place and turn; six printed decimals, like
// exporters write.
#pragma once
#include <fmt/format.h>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>
#include <string>

namespace test {

struct RandomRoom {
  std::string obj, mtl;
  int patches = 0;
};

/// Sides 0.5 to 2 and 3 to 9 cuts a side, the box up to 3 sides from the origin; the last face is
/// the lamp. `finer`: every patch is cut into finer x finer.
inline RandomRoom random_room(std::mt19937& random, double scale, int finer = 1) {
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (double(random()) + 0.5) / 0x1p32;
  };
  const glm::dvec3 side(uniform(0.5, 2), uniform(0.5, 2), uniform(0.5, 2));
  const glm::dvec3 place(uniform(-3, 3), uniform(-3, 3), uniform(-3, 3));
  const glm::dquat turn =
      glm::normalize(glm::dquat(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)));
  RandomRoom room;
  room.obj = "mtllib room.mtl\n";
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 corner(k & 1 ? side.x : 0, k & 2 ? side.y : 0, k & 4 ? side.z : 0);
    const glm::dvec3 x = scale * (place + turn * corner);
    room.obj += fmt::format("v {:.6e} {:.6e} {:.6e}\n", x.x, x.y, x.z);
  }
  const char* const faces[6] = {"1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4", "5 7 8 6", "1 2 4 3"};
  for (int f = 0; f < 6; ++f) {
    const int u = finer * (3 + int(random() % 7)), v = finer * (3 + int(random() % 7));
    room.obj +=
        fmt::format("# grid {} {}\nusemtl {}\nf {}\n", u, v, f < 5 ? "wall" : "lamp", faces[f]);
    room.patches += u * v;
  }
  room.mtl =
      fmt::format("newmtl wall\nKd {:.3f} {:.3f} {:.3f}\nnewmtl lamp\nKd 0 0 0\nKe 2 1 0.5\n",
                  uniform(0.1, 0.9), uniform(0.1, 0.9), uniform(0.1, 0.9));
  return room;
}

}  // namespace test
