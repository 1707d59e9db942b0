#include "solve/fixed_solve.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "urad/radiosity.hpp"

namespace host {

namespace {

constexpr int kMostShotsPerPatch = 512;  // far beyond what reflectances below 0.99 need

/// The engine's rows as a source: a load per factor.
urad_status rows_fill(void* context, std::uint16_t shooter, std::uint16_t, std::uint16_t first,
                      std::uint16_t count, std::uint32_t* f_uq32) {
  const auto& rows = *static_cast<const EngineRows*>(context);
  const auto from = rows.f_uq32.begin() + std::ptrdiff_t(shooter * rows.patches + first);
  std::copy(from, from + count, f_uq32);
  return URAD_OK;
}

Vec3 reflected(const Scene& scene, const std::vector<Vec3>& radiosity, std::size_t patch) {
  return radiosity[patch] - scene.material_of(patch).exitance;
}

bool reflects(const Scene& scene, std::size_t patch) {
  return scene.material_of(patch).reflectance != Vec3(0);
}

std::vector<Vec3> read_radiosity(const urad_radiosity& state, const FixedScene& fixed) {
  std::vector<Vec3> radiosity(fixed.pod().patch_count);
  for (std::size_t k = 0; k < radiosity.size(); ++k) {
    for (int c = 0; c < 3; ++c) {
      radiosity[k][c] = urad::radiosity_get(state, std::uint16_t(k), c) * fixed.exitance_unit();
    }
  }
  return radiosity;
}

}  // namespace

double relative_rms(const Scene& scene, const std::vector<Vec3>& radiosity,
                    const std::vector<Vec3>& truth) {
  double off = 0, all = 0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    if (!reflects(scene, k)) continue;
    const Vec3 d = radiosity[k] - truth[k], t = reflected(scene, truth, k);
    off += glm::dot(d, d);
    all += glm::dot(t, t);
  }
  return all > 0 ? std::sqrt(off / all) : 0;
}

double relative_max(const Scene& scene, const std::vector<Vec3>& radiosity,
                    const std::vector<Vec3>& truth) {
  double off = 0, most = 0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    if (!reflects(scene, k)) continue;
    const Vec3 d = glm::abs(radiosity[k] - truth[k]), t = glm::abs(reflected(scene, truth, k));
    off = std::max({off, d.x, d.y, d.z});
    most = std::max({most, t.x, t.y, t.z});
  }
  return most > 0 ? off / most : 0;
}

FixedSolution fixed_solve(const Scene& scene, const FixedScene& fixed, const EngineRows& rows,
                          const std::vector<Vec3>& converged, const SolveGoal& goal) {
  const urad_scene& pod = fixed.pod();
  const std::uint16_t run = urad::longest_run(pod);
  FixedSolution solution;
  solution.ram_bytes = urad::radiosity_bytes(pod.patch_count, run);
  std::vector<std::uint32_t> memory(solution.ram_bytes / 4);
  urad_radiosity state;
  const urad_source source{rows_fill, const_cast<EngineRows*>(&rows)};
  const auto start = std::chrono::steady_clock::now();
  urad::Status status =
      urad::radiosity_init(&state, &pod, source, goal.overshoot ? URAD_OVERSHOOT : 0, run,
                           memory.data(), solution.ram_bytes);

  if (status != urad::Status::ok) {  // nothing was written to the state
    solution.status = urad_status(status);
    return solution;
  }

  const int look = std::max(1, int(pod.patch_count) / 32);
  const int most = goal.shots.value_or(kMostShotsPerPatch * int(pod.patch_count));
  for (int shot = 0; shot < most && status == urad::Status::ok; ++shot) {
    if (!goal.shots && shot % look == 0) {
      if (relative_rms(scene, read_radiosity(state, fixed), converged) <= goal.error) break;
    }
    const std::uint32_t before = state.counters.shots;
    status = urad::radiosity_step(&state);
    if (state.counters.shots == before) break;  // nothing left to shoot
  }

  solution.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  solution.status = urad_status(status);
  solution.radiosity = read_radiosity(state, fixed);
  solution.error = relative_rms(scene, solution.radiosity, converged);
  for (std::size_t k = 0; k < pod.patch_count; ++k) {
    for (int c = 0; c < 3; ++c)
      solution.raw.push_back(urad::radiosity_get(state, std::uint16_t(k), c));
  }
  solution.shots = int(state.counters.shots);
  solution.ledger_exact = urad::radiosity_audit(state, &solution.ledger);
  solution.counters = state.counters;
  return solution;
}

}  // namespace host
