#include "solve/relight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "urad/radiosity.hpp"

namespace host {

namespace {

urad_status rows_fill(void* context, std::uint16_t shooter, std::uint16_t, std::uint16_t first,
                      std::uint16_t count, std::uint32_t* f_uq32) {
  const auto& rows = *static_cast<const EngineRows*>(context);
  std::copy_n(rows.f_uq32.begin() + std::ptrdiff_t(shooter * rows.patches + first), count, f_uq32);
  return URAD_OK;
}

void demand(urad::Status status, const char* what) {
  if (status != urad::Status::ok)
    throw Error(fmt::format("{}: the engine answered status {}", what, int(status)));
}

}  // namespace

Relighting::Relighting(const Scene& scene, EngineRows rows, bool overshoot)
    : scene_(scene), fixed_(scene), rows_(std::move(rows)), pod_(fixed_.pod()) {
  material_.assign(pod_.material, pod_.material + pod_.material_count);
  pod_.material = material_.data();
  for (std::size_t k = 0; k < scene.patches.size(); ++k)
    exitance_.push_back(scene.material_of(k).exitance);
  const std::uint16_t run = urad::longest_run(pod_);
  memory_.resize(urad::radiosity_bytes(pod_.patch_count, run) / 4);
  emitted_.resize(URAD_RELIGHT_BYTES(pod_.patch_count) / 4);
  demand(urad::radiosity_init(&state_, &pod_, {rows_fill, &rows_}, overshoot ? URAD_OVERSHOOT : 0,
                              run, memory_.data(), memory_.size() * 4),
         "starting a solve");
  demand(urad::radiosity_relight_init(&state_, emitted_.data(), emitted_.size() * 4),
         "making ready for light that changes");
}

void Relighting::emit(std::size_t patch, const Vec3& exitance) {
  std::int32_t integers[3];
  for (int c = 0; c < 3; ++c)
    integers[c] = std::int32_t(std::lround(exitance[c] / fixed_.exitance_unit()));
  demand(urad::radiosity_set_emission(&state_, std::uint16_t(patch), integers), "a lamp");
  exitance_[patch] = exitance;
}

void Relighting::paint(int material, const Vec3& reflectance) {
  std::uint16_t integers[3];
  for (int c = 0; c < 3; ++c) integers[c] = std::uint16_t(std::lround(32768 * reflectance[c]));
  demand(urad::radiosity_set_reflectance(&state_, &material_[std::size_t(material)], integers),
         "a wall");
}

int Relighting::step(int shots) {
  std::uint32_t made = 0;
  demand(urad::radiosity_steps(&state_, std::uint32_t(shots), 0, &made), "shooting");
  return int(made);
}

std::vector<Vec3> Relighting::radiosity() const {
  std::vector<Vec3> b(scene_.patches.size());
  for (std::size_t k = 0; k < b.size(); ++k) {
    for (int c = 0; c < 3; ++c)
      b[k][c] = urad::radiosity_get(state_, std::uint16_t(k), c) * fixed_.exitance_unit();
  }
  return b;
}

std::vector<Vec3> Relighting::display() const {
  std::vector<Vec3> b(scene_.patches.size());
  for (std::size_t k = 0; k < b.size(); ++k) {
    for (int c = 0; c < 3; ++c)
      b[k][c] = urad::radiosity_display(state_, std::uint16_t(k), c) * fixed_.exitance_unit();
  }
  return b;
}

std::vector<Vec3> Relighting::converged() const {
  const auto n = Eigen::Index(rows_.patches);
  std::vector<Vec3> b(rows_.patches);
  for (int c = 0; c < 3; ++c) {
    Eigen::MatrixXd m = Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd power(n);
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto& surface = scene_.surfaces[std::size_t(scene_.patches[std::size_t(j)].surface)];
      const double rho = material_[std::size_t(surface.material)].reflectance_uq15[c] / 32768.0;
      for (Eigen::Index i = 0; i < n; ++i) m(j, i) -= rho * rows_(std::size_t(i), std::size_t(j));
      power[j] = scene_.patches[std::size_t(j)].moments.area * exitance_[std::size_t(j)][c];
    }
    const Eigen::VectorXd x = m.partialPivLu().solve(power);
    for (Eigen::Index j = 0; j < n; ++j)
      b[std::size_t(j)][c] = x[j] / scene_.patches[std::size_t(j)].moments.area;
  }
  return b;
}

double Relighting::error(const std::vector<Vec3>& truth) const {
  const std::vector<Vec3> b = radiosity();
  double off = 0, all = 0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    if (scene_.material_of(k).reflectance == Vec3(0)) continue;
    const Vec3 d = b[k] - truth[k], t = truth[k] - exitance_[k];
    off += glm::dot(d, d);
    all += glm::dot(t, t);
  }
  return all > 0 ? std::sqrt(off / all) : 0;
}

}  // namespace host
