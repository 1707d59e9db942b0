// How long do all factors of the cube take on one core, and how wrong are they? rows/WAY.
// rms, max: of F - exact over pairs of patches on different walls. factor: CPU time by 294^2 factors.
#include <hwy/highway.h>

#include "fixtures.hpp"
#include "form_factor/lambert.hpp"
#include "lanes/lane_rows.hpp"
#include "method/engine_source.hpp"
#include "scene/builtin.hpp"

namespace {

using Factors = std::vector<double>;

struct Cube {
  host::Scene scene = host::load_scene("cube7");
  host::SceneSolver solver{scene, 2, true, 1};
  std::size_t n = scene.patches.size();
  urad_counters counters{};
  urad::PairSource pairs{&solver.fixed().pod(),
                         &fixtures::nets().find("cube7"),
                         urad::Kernel::moment,
                         0,
                         0,
                         &counters};
};

Cube& cube() {
  static Cube cube;
  return cube;
}

void report(benchmark::State& state, const Factors& f) {
  const Cube& c = cube();
  const Eigen::MatrixXd& exact = cube().solver.exact().form_factors;
  double squares = 0, most = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < c.n; ++i)
    for (std::size_t j = 0; j < c.n; ++j) {
      if (c.scene.patches[i].surface == c.scene.patches[j].surface) continue;
      const double error = std::fabs(f[i * c.n + j] - exact(Eigen::Index(i), Eigen::Index(j)));
      squares += error * error, ++count;
      most = std::max(most, error);
    }
  state.counters["rms"] = std::sqrt(squares / double(count));
  state.counters["max"] = most;
  state.counters["factor"] =
      benchmark::Counter(double(c.n * c.n), benchmark::Counter::kIsIterationInvariantRate |
                                                benchmark::Counter::kInvert);
}

Factors unpacked(const std::vector<std::uint32_t>& f_uq32) {
  Factors f(f_uq32.size());
  std::transform(f_uq32.begin(), f_uq32.end(), f.begin(), [](auto x) { return x * 0x1p-32; });
  return f;
}

/// What a program without anything else would do: Lambert's formula at 3 x 3 points of every pair.
void lambert(benchmark::State& state) {
  const Cube& c = cube();
  Factors f(c.n * c.n);
  for (auto _ : state)
    for (std::size_t i = 0; i < c.n; ++i)
      for (std::size_t j = 0; j < c.n; ++j) {
        const host::ScenePatch &p = c.scene.patches[i], &q = c.scene.patches[j];
        f[i * c.n + j] =
            p.surface == q.surface ? 0 : host::lambert_estimate(p.polygon, q.polygon, 3).f;
      }
  report(state, f);
}
BENCHMARK(lambert)->Name("rows/lambert:3, double, every pair")->Unit(benchmark::kMillisecond);

/// The engine's rows by one of its sources, as a chip makes them.
void engine(benchmark::State& state, const urad_source& source) {
  const Cube& c = cube();
  const urad_scene& scene = *c.pairs.scene;
  std::vector<std::uint32_t> f(c.n * c.n);
  for (auto _ : state)
    for (std::uint16_t i = 0; i < scene.patch_count; ++i)
      for (std::uint16_t s = 0; s < scene.surface_count; ++s) {
        const urad_surface& to = scene.surface[s];
        if (source.fill(source.context, i, s, to.first_patch, to.patch_count,
                        &f[i * c.n + to.first_patch]) != URAD_OK)
          state.SkipWithError("the engine refused");
      }
  report(state, unpacked(f));
}

void network(benchmark::State& state) { engine(state, {urad::pair_fill, &cube().pairs}); }
BENCHMARK(network)->Name("rows/net:cube7, engine, one by one")->Unit(benchmark::kMillisecond);

void by_method(benchmark::State& state, const char* method) {
  const host::EngineSource source(cube().solver.fixed(), host::parse_method(method),
                                  fixtures::nets(), {});
  engine(state, source.source());
}

/// The same integers, every pair once for both directions, without lanes.
void each_once(benchmark::State& state, const char* method) {
  const Cube& c = cube();
  const host::EngineSource source(c.solver.fixed(), host::parse_method(method), fixtures::nets(),
                                  {});
  std::vector<std::uint32_t> f(c.n * c.n);
  urad_counters counters{};
  for (auto _ : state) host::lane_rows(*source.pairs(), 1, f, &counters);
  report(state, unpacked(f));
}

/// The same integers in SIMD lanes.
void lanes(benchmark::State& state, std::int64_t target) {
  Cube& c = cube();
  hwy::SetSupportedTargetsForTest(target);
  std::vector<std::uint32_t> f(c.n * c.n);
  for (auto _ : state) host::lane_rows(c.pairs, 1, f, &c.counters);
  hwy::SetSupportedTargetsForTest(0);
  report(state, unpacked(f));
}

const bool kRegistered = [] {
  for (const char* method : {"auto:0.03", "auto", "auto:0.003", "fixed-lambert:3"}) {
    const std::string name = std::string("rows/") + method + ", each pair once";
    benchmark::RegisterBenchmark(name.c_str(), [method](benchmark::State& state) {
      each_once(state, method);
    })->Unit(benchmark::kMillisecond);
  }
  for (const char* method : {"fixed-moment", "auto:0.1", "auto:0.03", "auto", "auto:0.003",
                             "fixed-lambert:3", "legacy:linear50"}) {
    const std::string name = std::string("rows/") + method + ", engine, one by one";
    benchmark::RegisterBenchmark(name.c_str(), [method](benchmark::State& state) {
      by_method(state, method);
    })->Unit(benchmark::kMillisecond);
  }
  for (std::int64_t targets = hwy::SupportedTargets() & HWY_TARGETS; targets;
       targets &= targets - 1) {
    const std::int64_t one = targets & -targets;
    const std::string name = std::string("rows/net:cube7, lanes, ") + hwy::TargetName(one);
    benchmark::RegisterBenchmark(name.c_str(), [one](benchmark::State& state) {
      lanes(state, one);
    })->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
