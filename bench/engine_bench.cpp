// What do the parts of the engine cost on this machine, and what is the worst error of each?
// engine/PART. `worst` is absolute or relative as the row says, over a sweep or a set of pairs;
// time is per call.
#include <cmath>

#include "fixtures.hpp"
#include "form_factor/kernel.hpp"
#include "network/net_rounding.hpp"
#include "network/quantise.hpp"
#include "network/random.hpp"
#include "urad/clip.hpp"
#include "urad/form_factor.hpp"
#include "urad/log2.hpp"
#include "urad/network.hpp"
#include "urad/sigmoid.hpp"

namespace {

constexpr std::uint64_t kSeed = 20;
constexpr std::size_t kInputs = 4096;

/// Times f over inputs drawn by `draw`, one after the other.
template <class Draw, class F>
void time_function(benchmark::State& state, const char* error_name, double worst, const Draw& draw,
                   const F& f) {
  host::Random random(kSeed);
  std::vector<decltype(draw(random))> inputs;
  for (std::size_t k = 0; k < kInputs; ++k) inputs.push_back(draw(random));
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(f(inputs[k]));
    k = (k + 1) % kInputs;
  }
  state.counters[error_name] = worst;
}

void log2(benchmark::State& state) {
  double worst = 0;
  for (std::uint64_t x = 1; x < 1ull << 32; x += x / 50'021 + 1) {
    worst = std::max(worst,
                     std::fabs(urad::log2_q24(std::uint32_t(x)) * 0x1p-24 - std::log2(double(x))));
  }
  time_function(
      state, "worst_abs", worst,
      [](host::Random& random) { return std::uint32_t(random.log_uniform(1, 0x1p32)); },
      [](std::uint32_t x) { return urad::log2_q24(x); });
}
BENCHMARK(log2)->Name("engine/log2");

void exp2(benchmark::State& state) {
  double worst = 0;
  for (std::int32_t x = 0; x < 1 << 24; x += 7) {
    worst =
        std::max(worst, std::fabs(urad::exp2_uq(x, 30) / (0x1p30 * std::exp2(x * 0x1p-24)) - 1));
  }
  time_function(
      state, "worst_rel", worst,
      [](host::Random& random) { return std::int32_t(random.uniform(-0x1p28, 0)); },
      [](std::int32_t x) { return urad::exp2_uq(x, 30); });
}
BENCHMARK(exp2)->Name("engine/exp2");

void rsqrt(benchmark::State& state) {
  double worst = 0;
  for (std::uint64_t x = 1; x < 1ull << 62; x += x / 5'021 + 1) {
    const int bits = 31 + int(std::log2(double(x)) / 2);  // the result has 30 bits and more
    worst = std::max(
        worst, std::fabs(urad::rsqrt_uq(x, bits) * std::sqrt(double(x)) / std::exp2(bits) - 1));
  }
  time_function(
      state, "worst_rel", worst,
      [](host::Random& random) { return std::uint64_t(random.log_uniform(1, 0x1p62)); },
      [](std::uint64_t x) { return urad::rsqrt_uq(x, 31); });
}
BENCHMARK(rsqrt)->Name("engine/rsqrt");

void sigmoid(benchmark::State& state) {
  double worst = 0;
  for (int x = -32768; x <= 32767; ++x) {
    worst = std::max(worst, std::fabs(urad::sigmoid_uq15(std::int16_t(x)) * 0x1p-15 -
                                      1 / (1 + std::exp(-x / 2048.0))));
  }
  time_function(
      state, "worst_abs", worst,
      [](host::Random& random) { return std::int16_t(random.uniform(-32767, 32768)); },
      [](std::int16_t x) { return urad::sigmoid_uq15(x); });
}
BENCHMARK(sigmoid)->Name("engine/sigmoid");

bool invariants(const fixtures::Pair& pair, urad::Pair* result) {
  const urad_scene& scene = pair.scene->pod();
  const urad::Patch i = urad::patch_at(scene, pair.i), j = urad::patch_at(scene, pair.j);
  return urad::pair_invariants(*i.shape, i.centroid, *j.shape, j.centroid, result);
}

/// Worst: of log2 of the moment kernel, against doubles.
void pair_invariants(benchmark::State& state) {
  const std::vector<fixtures::Pair>& pairs = fixtures::pair_set("cube").pairs;
  double worst = 0;
  urad::Pair result;
  for (const fixtures::Pair& pair : pairs) {
    if (!invariants(pair, &result)) return state.SkipWithError("a pair was refused");
    const double kernel = host::moment_kernel(host::moments(*pair.p), host::moments(*pair.q));
    const double log2_kernel = (result.log2_kernel_q24 + result.log2_bend_q24) * 0x1p-24;
    worst = std::max(worst, std::fabs(log2_kernel - std::log2(kernel) -
                                      2 * std::log2(pair.scene->units_per_length())));
  }
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(invariants(pairs[k], &result));
    benchmark::ClobberMemory();
    if (++k == pairs.size()) k = 0;
  }
  state.counters["worst_abs"] = worst;
}
BENCHMARK(pair_invariants)->Name("engine/pair_invariants");

/// Worst: of y in units of log2, against the same network in doubles.
void network_run(benchmark::State& state) {
  const int hidden = int(state.range(0));
  host::Random random(kSeed);
  host::FloatNet net(urad::kPairInputs, hidden);
  for (double& parameter : net.parameters) parameter = random.normal();
  const host::QuantisedNet quantised(host::round_net(net, 16, 0));
  std::vector<urad::Pair> inputs;
  double worst = 0;
  for (const fixtures::Pair& pair : fixtures::pair_set("cube").pairs) {
    if (inputs.size() == kInputs) break;
    if (!invariants(pair, &inputs.emplace_back())) return state.SkipWithError("a pair was refused");
    const std::int16_t* input_q15 = inputs.back().input_q15;
    worst = std::max(worst, std::fabs(urad::network_run(quantised.pod(), input_q15) * 0x1p-16 -
                                      net.run(input_q15)));
  }
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(urad::network_run(quantised.pod(), inputs[k].input_q15));
    k = (k + 1) % inputs.size();
  }
  state.counters["worst_abs"] = worst;
  state.counters["macs"] = hidden * (urad::kPairInputs + 1) + urad::kPairInputs;
}
BENCHMARK(network_run)->Name("engine/network_run/H")->Arg(4)->Arg(8)->Arg(16);

/// All 49 factors of the opposite or an adjoining wall by the network of the cube. Worst: of F,
/// relative.
void grid_run(benchmark::State& state) {
  host::SceneSolver& solver = fixtures::solver("cube7");
  const host::FixedScene fixed(solver.scene());
  const urad_scene& scene = fixed.pod();
  urad_counters counters{};
  urad::PairSource source{&scene,   &fixtures::nets().find("cube7"), urad::Kernel::moment, 0, 0,
                          &counters};
  std::vector<std::uint32_t> f_uq32(scene.patch_count);
  const auto fill = [&](std::uint16_t shooter, const urad_surface& to) {
    return urad::pair_fill(&source, shooter, std::uint16_t(&to - scene.surface), to.first_patch,
                           to.patch_count, f_uq32.data());
  };
  double worst = 0;
  for (std::uint16_t s = 1; s < scene.surface_count; ++s) {
    const urad_surface& to = scene.surface[s];
    for (std::uint16_t shooter = 0; shooter < scene.surface[0].patch_count; ++shooter) {
      if (fill(shooter, to) != URAD_OK) return state.SkipWithError("the engine refused");
      for (std::uint16_t k = 0; k < to.patch_count; ++k) {
        const double exact = solver.exact().form_factors(shooter, to.first_patch + k);
        worst = std::max(worst, std::fabs(f_uq32[k] * 0x1p-32 / exact - 1));
      }
    }
  }
  std::uint16_t shooter = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(fill(shooter, scene.surface[1 + shooter % (scene.surface_count - 1)]));
    benchmark::ClobberMemory();
    if (++shooter == scene.surface[0].patch_count) shooter = 0;
  }
  state.counters["worst_rel"] = worst;
}
BENCHMARK(grid_run)->Name("engine/run_of_49");

/// Quads cut by the plane of another one. Worst: of the area left, relative, where at least a tenth
/// is left.
void clip(benchmark::State& state) {
  struct Cut {
    host::FixedScene scene;
    urad::Patch patch, plane;
  };
  host::Random random(kSeed);
  std::vector<Cut> cuts;
  const auto point = [&] {
    return host::Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  };
  double worst = 0;
  while (cuts.size() < kInputs) {
    const host::Polygon quad{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {}},
        plane{{point(), point(), point()}, {}};
    const host::Moments whole = host::moments(quad), cutter = host::moments(plane);
    if (cutter.area < 0.1) continue;
    const double left =
        host::moments(host::clip(quad, cutter.centroid, cutter.normal)).area / whole.area;
    if (left < 0.1 || left > 0.999) continue;
    const auto fixed = host::FixedScene::of_polygons({quad, plane}, {});
    const Cut& cut = cuts.emplace_back(
        Cut{fixed, urad::patch_at(fixed.pod(), 0), urad::patch_at(fixed.pod(), 1)});
    urad_shape shape;
    urad_point centroid;
    if (!urad::clipped_shape(fixed.pod(), cut.patch, cut.plane.centroid,
                             cut.plane.shape->normal_q30, &shape, &centroid)) {
      return state.SkipWithError("a cut was refused");
    }
    const double area = std::exp2((shape.log2_area_q24 - cut.patch.shape->log2_area_q24) * 0x1p-24);
    worst = std::max(worst, std::fabs(area / left - 1));
  }
  std::size_t k = 0;
  urad_shape shape;
  urad_point centroid;
  for (auto _ : state) {
    const Cut& cut = cuts[k];
    benchmark::DoNotOptimize(urad::clipped_shape(cut.scene.pod(), cut.patch, cut.plane.centroid,
                                                 cut.plane.shape->normal_q30, &shape, &centroid));
    benchmark::ClobberMemory();
    k = (k + 1) % cuts.size();
  }
  state.counters["worst_rel"] = worst;
}
BENCHMARK(clip)->Name("engine/clip");

}  // namespace
