// How fine a hemicube is fine enough? hemicube/SCENE/R: time per shot of a turned hemicube of
// resolution R, and beside it of the 1996 report's network, which is to take its place.
//
//   f_std       deviation of F - exact over pairs of patches on different planes
//   row_worst   largest |row sum - exact row sum|
//   b_rms       relative rms of the radiosity that these factors converge to, against the exact one
//   ram         bytes of the source on a chip
//   m0_shot     Cortex-M0 instructions per shot of the cube, counted
#include <array>

#include "fixtures.hpp"
#include "method/engine_source.hpp"

namespace {

constexpr std::array kScenes = {"cube7", "cornell"};
constexpr std::array kResolutions = {16, 32, 64, 128};
constexpr double kConverged = 1e-4;  // of B against its own limit

void add_row(const std::string& scene, const std::string& method, const std::string& name) {
  const auto row =
      [=, known = std::make_shared<std::optional<host::MethodRun>>()](benchmark::State& state) {
        host::SceneSolver& solver = fixtures::solver(scene);
        const host::MethodSpec spec = host::parse_method(method);
        if (!*known) *known = solver.run(spec, fixtures::nets(), {std::nullopt, kConverged, true});
        const host::MethodRun& run = **known;
        const host::EngineSource source(solver.fixed(), spec, fixtures::nets(), {});
        const std::uint16_t patches = solver.fixed().pod().patch_count;
        std::vector<std::uint32_t> f_uq32(patches);
        std::uint16_t shooter = 0;
        for (auto _ : state) {
          source.row(shooter, f_uq32.data());
          benchmark::DoNotOptimize(f_uq32.data());
          benchmark::ClobberMemory();
          if (++shooter == patches) shooter = 0;
        }
        state.counters["f_std"] = run.factors.std;
        state.counters["row_worst"] = run.factors.row_worst;
        state.counters["b_rms"] = run.rms;
        state.counters["ram"] = double(source.ram_bytes());
        if (scene == "cube7" && fixtures::instructions()) {
          fixtures::show_instructions(state, "m0_shot", fixtures::instructions()->per_shot(method));
        }
      };
  benchmark::RegisterBenchmark(("hemicube/" + scene + "/" + name).c_str(), row)
      ->Unit(benchmark::kMicrosecond);
}

const bool added = [] {
  for (const char* scene : kScenes) {
    for (const int resolution : kResolutions)
      add_row(scene, "hemicube:" + std::to_string(resolution), std::to_string(resolution));
    add_row(scene, "legacy:linear50", "legacy:linear50");
  }
  return true;
}();

}  // namespace
