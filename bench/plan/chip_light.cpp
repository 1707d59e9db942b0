#include "chip_light.hpp"

#include "base/error.hpp"
#include "solve/scene_solver.hpp"
#include "urad/radiosity.hpp"

namespace bench {

namespace {

urad_status rows_fill(void* context, std::uint16_t i, std::uint16_t, std::uint16_t first,
                      std::uint16_t count, std::uint32_t* f_uq32) {
  const auto& rows = *static_cast<const host::EngineRows*>(context);
  std::copy_n(rows.f_uq32.begin() + std::ptrdiff_t(i * rows.patches + first), count, f_uq32);
  return URAD_OK;
}

}  // namespace

double chip_light_error(const host::Scene& scene, const host::MethodSpec& spec,
                        const host::NetChoice& nets, double stop) {
  host::SceneSolver solver(scene, 0, true);
  host::SolveGoal goal;
  goal.shots = 1;  // only its factors and their repair are wanted
  host::MethodRun run = solver.run(spec, nets, goal);
  host::FixedScene fixed(scene);
  if (!run.scale.empty()) {
    fixed.set_scale(run.scale);
    run.rows = host::engine_rows(fixed, spec, nets, {}, 0);
  }
  const urad_scene& pod = fixed.pod();
  const std::uint16_t longest = urad::longest_run(pod);
  std::vector<std::uint32_t> memory(urad::radiosity_bytes(pod.patch_count, longest) / 4);
  urad_radiosity state;
  urad::Status status = urad::radiosity_init(&state, &pod, {rows_fill, &run.rows}, URAD_OVERSHOOT,
                                             longest, memory.data(), 4 * memory.size());
  while (status == urad::Status::ok && !urad::radiosity_done(state, std::uint32_t(stop * 0x1p32)))
    status = urad::radiosity_step(&state);
  if (status != urad::Status::ok) throw host::Error(scene.name + ": the engine stopped solving");
  std::vector<host::Vec3> light(pod.patch_count);
  for (std::uint16_t k = 0; k < pod.patch_count; ++k)
    for (int c = 0; c < 3; ++c)
      light[k][c] = urad::radiosity_get(state, k, c) * fixed.exitance_unit();
  return host::relative_rms(scene, light, solver.exact().radiosity);
}

}  // namespace bench
