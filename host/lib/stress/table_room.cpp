#include "stress/table_room.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace host {

TableRoom::TableRoom(int surfaces, int patches_each, bool closed)
    : polygon_(std::size_t(surfaces * patches_each)), material_(std::size_t(surfaces)) {
  for (int s = 0; s < surfaces; ++s)
    surface_.push_back({std::uint16_t(s * patches_each), std::uint16_t(patches_each),
                        std::uint16_t(s), 0, nullptr, polygon_.data() + s * patches_each});
  scene_.abi = URAD_SCENE_ABI;
  scene_.flags = closed ? URAD_SCENE_CLOSED : 0;
  scene_.patch_count = std::uint16_t(polygon_.size());
  scene_.surface_count = scene_.material_count = std::uint16_t(surfaces);
  scene_.surface = surface_.data();
  scene_.material = material_.data();
}

urad_source TableRoom::source() { return {fill, this}; }

double TableRoom::area(int i) const {
  return std::exp2(polygon_[std::size_t(i)].shape.log2_area_q24 * 0x1p-24);
}

void TableRoom::spread_areas(double spread, Random& random) {
  for (urad_polygon& polygon : polygon_)
    polygon.shape.log2_area_q24 =
        std::int32_t(std::lround(std::log2(random.log_uniform(1, spread)) * 0x1p24));
}

void TableRoom::set(int surface, const double (&reflectance)[3],
                    const std::int32_t (&exitance)[3]) {
  urad_material& material = material_[std::size_t(surface)];
  for (int c = 0; c < 3; ++c) {
    material.reflectance_uq15[c] = std::uint16_t(std::lround(32768 * reflectance[c]));
    material.exitance[c] = exitance[c];
  }
}

void TableRoom::fill_reciprocal(double sum, Random& random) {
  const int n = patches();
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < i; ++j)
      if (i / each() != j / each()) g(i, j) = g(j, i) = std::pow(random.uniform(), 4) + 1e-3;
  for (int sweep = 0; sweep < 100; ++sweep)
    for (int i = 0; i < n; ++i) {
      const double total = g.row(i).sum();
      if (!(total > 0)) continue;
      const double d = std::sqrt(sum * area(i) / total);
      g.row(i) *= d;
      g.col(i) *= d;
    }
  factor_.resize(std::size_t(n) * std::size_t(n));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      factor_[std::size_t(i * n + j)] =
          std::uint32_t(std::llround(std::min(g(i, j) / area(i) * 0x1p32, 0x1p32 - 1)));
}

void TableRoom::fill_anything(double most, Random& random) {
  const int n = patches();
  factor_.assign(std::size_t(n) * std::size_t(n), 0);
  for (int i = 0; i < n; ++i) {
    const double mean = random.uniform(0, most) / n;
    for (int j = 0; j < n; ++j)
      if (i != j)
        factor_[std::size_t(i * n + j)] =
            std::uint32_t(std::min(2 * mean * random.uniform(), 0.9999) * 0x1p32);
  }
}

void TableRoom::emit_power(double power) {
  double emitted = 0;
  for (int i = 0; i < patches(); ++i)
    for (int c = 0; c < 3; ++c) emitted += area(i) * material_of(i).exitance[c];
  scene_.log2_power_q24 = std::int32_t(std::floor(std::log2(power / emitted) * 0x1p24));
}

Eigen::VectorXd TableRoom::exact(int channel) const {
  const int n = patches();
  const bool closed = scene_.flags & URAD_SCENE_CLOSED;
  Eigen::MatrixXd m = Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd power(n);
  for (int j = 0; j < n; ++j) {
    const std::uint32_t* row = factor_.data() + std::size_t(j) * std::size_t(n);
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += row[i] * 0x1p-32;
    const double scale = closed || sum > 1 ? 1 / sum : 1;
    for (int i = 0; i < n; ++i)
      m(i, j) -= material_of(i).reflectance_uq15[channel] * 0x1p-15 * scale * row[i] * 0x1p-32;
    power(j) = area(j) * material_of(j).exitance[channel];
  }
  Eigen::VectorXd b = m.partialPivLu().solve(power);
  for (int i = 0; i < n; ++i) b(i) /= area(i);
  return b;
}

urad_status TableRoom::fill(void* room, std::uint16_t shooter, std::uint16_t surface,
                            std::uint16_t first, std::uint16_t count, std::uint32_t* f_uq32) {
  const TableRoom& self = *static_cast<const TableRoom*>(room);
  const int n = self.patches();
  if (surface >= self.scene_.surface_count || first / self.each() != surface ||
      (first + count - 1) / self.each() != surface)
    return URAD_BAD_ARGUMENT;  // a run across surfaces: the contract is broken
  for (int k = 0; k < count; ++k)
    f_uq32[k] = self.factor_.empty()
                    ? std::uint32_t(0x1p32 / n)
                    : self.factor_[std::size_t(shooter) * std::size_t(n) + std::size_t(first + k)];
  return URAD_OK;
}

}  // namespace host
