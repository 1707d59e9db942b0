// What does the light of a scene cost by each method, and how wrong is it? solve/SCENE/METHOD: time
// of one solve on one core as a chip does it, from init to the shot at which B is within 1 % of
// what the method converges to; every factor is evaluated when it is needed, none is stored.
// "exact": all factors by the reference, and a dense solve, on one core.
//
//   b_rms b_max   radiosity at that shot, relative, against the exact one       b_limit   the same
//   after many more shots f_std         deviation of F - exact over pairs on different planes,
//   before repair shots, ram    of solver and source, bytes on a chip       m0_shot   Cortex-M0
//   instructions of a shot of the cube
#include <array>

#include "fixtures.hpp"
#include "method/engine_source.hpp"
#include "solve/exact.hpp"
#include "urad/radiosity.hpp"

namespace {

constexpr std::array kScenes = {"cube7", "cornell"};
constexpr std::array kMethods = {"fixed-kernel", "fixed-moment", "net:general",
                                 "auto",         "hemicube:32",  "hemicube:64",
                                 "hybrid:32",    "hybrid:64",    "legacy:linear50"};
constexpr double kGood = 0.01, kConverged = 1e-4;
constexpr int kExactRays = 1024;

struct Known {
  host::MethodRun run;
  double b_limit = 0;
};

Known measure(host::SceneSolver& solver, const host::MethodSpec& spec) {
  Known known;
  known.b_limit = solver.run(spec, fixtures::nets(), {std::nullopt, kConverged, true}).rms;
  known.run = solver.run(spec, fixtures::nets(), {std::nullopt, kGood, true});
  return known;
}

/// The solve as a chip does it: false when the engine refuses.
bool solve(const urad_scene& scene, const urad_source& source, int shots,
           std::vector<std::uint32_t>* memory, urad_radiosity* state) {
  const std::uint16_t run = urad::longest_run(scene);
  memory->resize(urad::radiosity_bytes(scene.patch_count, run) / 4);
  urad::Status status = urad::radiosity_init(state, &scene, source, URAD_OVERSHOOT, run,
                                             memory->data(), memory->size() * 4);
  for (int k = 0; k < shots && status == urad::Status::ok; ++k)
    status = urad::radiosity_step(state);
  return status == urad::Status::ok;
}

/// The timed solve has the integers of the one whose error is shown.
bool same_light(const urad_radiosity& state, const host::FixedSolution& solution) {
  for (std::size_t k = 0; k < solution.raw.size(); ++k) {
    if (urad::radiosity_get(state, std::uint16_t(k / 3), int(k % 3)) != solution.raw[k])
      return false;
  }
  return true;
}

void add_method(const std::string& scene, const std::string& method) {
  const auto row = [=, kept = std::make_shared<std::optional<Known>>()](benchmark::State& state) {
    host::SceneSolver& solver = fixtures::solver(scene);
    const host::MethodSpec spec = host::parse_method(method);
    if (!*kept) *kept = measure(solver, spec);
    const auto& [run, b_limit] = **kept;
    host::FixedScene fixed(solver.scene());
    fixed.set_scale(run.scale);
    const host::EngineSource source(fixed, spec, fixtures::nets(), {});
    std::vector<std::uint32_t> memory;
    urad_radiosity light;
    for (auto _ : state) {
      if (!solve(fixed.pod(), source.source(), run.solution.shots, &memory, &light)) {
        return state.SkipWithError("the engine refused");
      }
      benchmark::DoNotOptimize(memory.data());
      benchmark::ClobberMemory();
    }
    if (!same_light(light, run.solution))
      return state.SkipWithError("not the light whose error is known");
    state.counters["b_rms"] = run.rms;
    state.counters["b_max"] = run.max;
    state.counters["b_limit"] = b_limit;
    state.counters["f_std"] = run.factors.std;
    state.counters["shots"] = run.solution.shots;
    state.counters["ram"] = double(run.solution.ram_bytes + source.ram_bytes());
    if (scene == "cube7" && fixtures::instructions()) {
      const std::string counted = method == "net:cube7" ? "net" : method;
      fixtures::show_instructions(state, "m0_shot", fixtures::instructions()->per_shot(counted));
    }
  };
  benchmark::RegisterBenchmark(("solve/" + scene + "/" + method).c_str(), row)
      ->Unit(benchmark::kMillisecond);
}

void add_exact(const std::string& name) {
  const auto row = [=](benchmark::State& state) {
    host::SceneSolver& solver = fixtures::solver(name);
    const host::Scene& scene = solver.scene();
    std::vector<host::Vec3> light;
    for (auto _ : state) {
      light = host::exact_radiosity(scene, host::exact_form_factors(scene, 1, kExactRays));
      benchmark::DoNotOptimize(light.data());
    }
    state.counters["b_rms"] = host::relative_rms(scene, light, solver.exact().radiosity);
  };
  benchmark::RegisterBenchmark(("solve/" + name + "/exact").c_str(), row)
      ->Unit(benchmark::kMillisecond)
      ->Iterations(1);
}

const bool added = [] {
  for (const char* scene : kScenes) {
    add_exact(scene);
    add_method(scene, std::string("net:") + scene);
    for (const char* method : kMethods) add_method(scene, method);
  }
  return true;
}();

}  // namespace
