// A scene whose form factors are a table of integers: what a solver sees, without geometry.
#pragma once
#include <Eigen/Dense>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "urad/radiosity.hpp"

namespace test {

struct TableScene {
  std::vector<urad_polygon> polygon;
  std::vector<urad_surface> surface;
  std::vector<urad_material> material;
  std::vector<std::vector<uint32_t>> row;  // row[i][j] = F_ij, UQ0.32
  urad_scene pod{};
  int fail_after = -1;  // calls of fill until it fails; -1: never
  uint32_t calls = 0;

  TableScene(int surfaces, int patches_each, uint16_t flags) {
    const int n = surfaces * patches_each;
    polygon.resize(size_t(n));
    material.resize(size_t(surfaces));
    row.assign(size_t(n), std::vector<uint32_t>(size_t(n), 0));
    for (int s = 0; s < surfaces; ++s) {
      surface.push_back({uint16_t(s * patches_each), uint16_t(patches_each), uint16_t(s), 0,
                         nullptr, polygon.data() + s * patches_each});
    }
    pod.abi = URAD_SCENE_ABI;
    pod.flags = flags;
    pod.patch_count = uint16_t(n);
    pod.surface_count = pod.material_count = uint16_t(surfaces);
    pod.surface = surface.data();
    pod.material = material.data();
  }
  TableScene(const TableScene&) = delete;

  int patches() const { return pod.patch_count; }
  int each() const { return pod.patch_count / pod.surface_count; }
  double area(int i) const { return std::exp2(polygon[size_t(i)].shape.log2_area_q24 / 0x1p24); }
  const urad_material& material_of(int i) const { return material[size_t(i / each())]; }
  double reflectance(int i, int c) const { return material_of(i).reflectance_uq15[c] / 32768.0; }

  void set(int s, std::array<double, 3> reflectance, std::array<int32_t, 3> exitance) {
    for (size_t c = 0; c < 3; ++c) {
      material[size_t(s)].reflectance_uq15[c] = uint16_t(std::lround(32768 * reflectance[c]));
      material[size_t(s)].exitance[c] = exitance[c];
    }
  }

  /// Random areas within a factor 4 and reciprocal rows that sum to `sum`: A_i F_ij = A_j F_ji,
  /// none within a surface.
  void fill_reciprocal(std::mt19937& random, double sum) {
    const int n = patches();
    std::uniform_real_distribution<double> uniform(0, 1);
    for (auto& p : polygon) p.shape.log2_area_q24 = int32_t(std::lround(uniform(random) * 0x1p25));
    Eigen::MatrixXd g = Eigen::MatrixXd::Zero(n, n);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < i; ++j) {
        if (i / each() != j / each()) g(i, j) = g(j, i) = std::pow(uniform(random), 4) + 1e-3;
      }
    }
    set_rows(g, sum);
  }

  /// Scales symmetric exchanges until rows sum to `sum`, and rounds G / A to the table.
  void set_rows(Eigen::MatrixXd& g, double sum) {
    const int n = patches();
    for (int sweep = 0; sweep < 200; ++sweep) {
      for (int i = 0; i < n; ++i) {
        const double d = std::sqrt(sum * area(i) / g.row(i).sum());
        g.row(i) *= d;
        g.col(i) *= d;
      }
    }
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const double f_uq32 = std::min(g(i, j) / area(i) * 0x1p32, 0x1p32 - 1);
        row[size_t(i)][size_t(j)] = uint32_t(std::lround(f_uq32));
      }
    }
  }

  /// The six walls of a cube: exchanges of the patches' centres, near pairs limited, rows repaired.
  void fill_cube() {
    const int m = int(std::lround(std::sqrt(each()))), n = patches();
    const auto centre = [m, this](int i) {
      const int axis = i / each() / 2, k = i % each(), u = k % m, v = k / m;
      Eigen::Vector3d x;
      x[axis] = i / each() % 2;
      x[(axis + 1) % 3] = (u + 0.5) / m;
      x[(axis + 2) % 3] = (v + 0.5) / m;
      return x;
    };
    const auto normal = [this](int i) -> Eigen::Vector3d {
      return Eigen::Vector3d::Unit(i / each() / 2) * (i / each() % 2 ? -1 : 1);
    };
    Eigen::MatrixXd g = Eigen::MatrixXd::Zero(n, n);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < i; ++j) {
        if (i / each() == j / each()) continue;
        const Eigen::Vector3d r = centre(j) - centre(i);
        const double kernel = normal(i).dot(r) * -normal(j).dot(r) /
                              (3.14159265358979 * std::pow(r.squaredNorm(), 2) * each());
        g(i, j) = g(j, i) = std::min(kernel, 0.2);
      }
    }
    set_rows(g, 1);
  }

  /// B in exitance units of the same integer factors, each row divided by its sum where that is
  /// above 1 (or always).
  Eigen::VectorXd exact(int channel, bool normalise = false) const {
    const int n = patches();
    Eigen::MatrixXd m = Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd power(n);
    for (int j = 0; j < n; ++j) {
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += row[size_t(j)][size_t(i)] / 0x1p32;
      const double scale = normalise || sum > 1 ? 1 / sum : 1;
      for (int i = 0; i < n; ++i) {
        m(i, j) -= reflectance(i, channel) * scale * row[size_t(j)][size_t(i)] / 0x1p32;
      }
      power(j) = area(j) * material_of(j).exitance[channel];
    }
    Eigen::VectorXd b = m.partialPivLu().solve(power);
    for (int i = 0; i < n; ++i) b(i) /= area(i);
    return b;
  }

  static urad_status fill(void* context, uint16_t shooter, uint16_t surface, uint16_t first,
                          uint16_t count, uint32_t* f_uq32) {
    auto& self = *static_cast<TableScene*>(context);
    if (surface >= self.pod.surface_count || first / self.each() != surface ||
        (first + count - 1) / self.each() != surface) {
      return URAD_BAD_ARGUMENT;  // a run across surfaces: the contract is broken
    }
    if (self.fail_after == 0) return URAD_BAD_NET;
    if (self.fail_after > 0) --self.fail_after;
    ++self.calls;
    for (int k = 0; k < count; ++k) f_uq32[k] = self.row[shooter][size_t(first + k)];
    return URAD_OK;
  }
  urad_source source() { return {fill, this}; }
};

/// Whether nothing was written to a state, not even to what lies between its members.
inline bool same_bytes(const urad_radiosity& a, const urad_radiosity& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;  // NOLINT(bugprone-suspicious-memory-comparison)
}

/// A state with memory of its own.
struct Solve {
  TableScene& scene;
  std::vector<uint32_t> memory;
  urad::Radiosity state{};
  urad::Status status;

  explicit Solve(TableScene& s, unsigned flags = 0, uint16_t run = 0)
      : scene(s),
        memory(urad::radiosity_bytes(s.pod.patch_count, run ? run : urad::longest_run(s.pod)) / 4),
        status(urad::radiosity_init(&state, &s.pod, s.source(), flags,
                                    run ? run : urad::longest_run(s.pod), memory.data(),
                                    memory.size() * 4)) {}

  /// Shots until done; at most `most`.
  int run(double error, int most = 100000) {
    int shots = 0;
    for (; shots < most && !urad::radiosity_done(state, uint32_t(error * 0x1p32)); ++shots) {
      status = urad::radiosity_step(&state);
      if (status != urad::Status::ok) break;
    }
    return shots;
  }

  /// sqrt(mean (B - exact)^2 / mean exact^2), over all patches and channels that receive light.
  double relative_rms(bool normalise = false) const {
    double error = 0, all = 0;
    for (int c = 0; c < 3; ++c) {
      const Eigen::VectorXd b = scene.exact(c, normalise);
      for (int i = 0; i < scene.patches(); ++i) {
        const double e = scene.material_of(i).exitance[c];
        error += std::pow(urad::radiosity_get(state, uint16_t(i), c) - b(i), 2);
        all += std::pow(b(i) - e, 2);
      }
    }
    return std::sqrt(error / all);
  }

  bool same_light(const Solve& other) const {
    const size_t n = 6 * size_t(scene.patches());
    return std::equal(memory.begin(), memory.begin() + long(n), other.memory.begin());
  }
};

/// A closed room: lamp, red, blue and white surfaces; powers near 2^26 a patch.
inline void furnish(TableScene* room, double white = 0.8) {
  const int n = room->pod.surface_count;
  for (int s = 0; s < n; ++s) room->set(s, {white, white, white}, {0, 0, 0});
  room->set(0, {0, 0, 0}, {960000, 800000, 480000});
  if (n > 1) room->set(1, {0.75, 0.1, 0.1}, {0, 0, 0});
  if (n > 2) room->set(2, {0.1, 0.1, 0.75}, {0, 0, 0});
  room->pod.log2_power_q24 = 6 << 24;
}

}  // namespace test
