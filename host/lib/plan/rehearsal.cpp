#include "plan/rehearsal.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "urad/form_factor.hpp"
#include "urad/radiosity.hpp"

namespace host {

namespace {

constexpr std::uint16_t kRays = 2;
constexpr double kMostPairs = 3e6, kMostPairsWithRays = 3e5;

/// Rows of the centre kernel, one held, summing to 1 in a closed scene and to 1 at most in an open
/// one.
struct CoarseRows {
  const urad_scene& scene;
  urad_counters counters{};
  urad::PairSource pairs{};
  std::vector<std::uint32_t> row;
  int shooter = -1;

  explicit CoarseRows(const urad_scene& pod) : scene(pod), row(pod.patch_count) {
    pairs = {&scene, nullptr, urad::Kernel::centre, kRays, 0, &counters, 0};
  }

  void find(std::uint16_t i) {
    shooter = i;
    double sum = 0;
    for (std::uint16_t s = 0; s < scene.surface_count; ++s) {
      const urad_surface& to = scene.surface[s];
      urad::pair_fill(&pairs, i, s, to.first_patch, to.patch_count, &row[to.first_patch]);
    }
    for (const std::uint32_t f : row) sum += f;
    const bool closed = scene.flags & URAD_SCENE_CLOSED;
    if (sum == 0 || (!closed && sum <= 0x1p32)) return;
    for (std::uint32_t& f : row)
      f = std::uint32_t(std::min(double(f) * (0x1p32 / sum), 0x1p32 - 1));
  }
};

urad_status coarse_fill(void* context, std::uint16_t shooter, std::uint16_t, std::uint16_t first,
                        std::uint16_t count, std::uint32_t* f_uq32) {
  auto& rows = *static_cast<CoarseRows*>(context);
  if (rows.shooter != shooter) rows.find(shooter);
  std::copy_n(rows.row.begin() + first, count, f_uq32);
  return URAD_OK;
}

}  // namespace

Rehearsal rehearse(const FixedScene& scene, double error) {
  const urad_scene& pod = scene.pod();
  CoarseRows rows(pod);
  const std::uint16_t run = urad::longest_run(pod);
  std::vector<std::uint32_t> memory(urad::radiosity_bytes(pod.patch_count, run) / 4);
  urad_radiosity state;
  if (urad::radiosity_init(&state, &pod, {coarse_fill, &rows}, URAD_OVERSHOOT, run, memory.data(),
                           4 * memory.size()) != urad::Status::ok)
    throw Error("the engine refuses to solve this scene");
  const auto stop = std::uint32_t(std::min(error * 0x1p32, 0x1p32 - 1));
  const double pairs = pod.flags & URAD_SCENE_CONVEX ? kMostPairs : kMostPairsWithRays;
  const double most_shots = std::max(pairs / pod.patch_count, 2.0);
  Rehearsal rehearsal;
  std::vector<double> estimates;
  while (!urad::radiosity_done(state, stop)) {
    if (double(rehearsal.shooters.size()) >= most_shots) {
      rehearsal.complete = false;
      break;
    }
    rehearsal.shooters.push_back(state.shooter);
    if (urad::radiosity_step(&state) != urad::Status::ok) break;
    estimates.push_back(urad::radiosity_error_uq32(state) / 0x1p32);
  }
  rehearsal.shots = double(rehearsal.shooters.size());
  rehearsal.updates = state.counters.updates;
  for (std::uint16_t k = 0; k < pod.patch_count; ++k) {
    double sum = 0;
    for (int c = 0; c < 3; ++c) sum += urad::radiosity_get(state, k, c);
    rehearsal.light.push_back(std::max(0.0, sum / 3));
  }
  if (!rehearsal.complete && estimates.size() > 2) {
    // The estimate falls as a power of e over shots: its pace over the last half goes on.
    const double middle = estimates[estimates.size() / 2], last = estimates.back();
    const double pace = std::log(middle / last) / (0.5 * rehearsal.shots);
    const double more = pace > 0 ? std::log(last / error) / pace : 0;
    rehearsal.updates *= 1 + more / rehearsal.shots;
    rehearsal.shots += more;
  }
  return rehearsal;
}

}  // namespace host
