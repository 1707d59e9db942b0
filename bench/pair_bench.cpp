// What does one form factor cost, and how wrong is it? pair/SET/METHOD: time per ordered pair,
// errors against the reference on the same pairs (fixtures.hpp describes the sets), of the
// reference by its own estimate.
//
//   rel_median rel_p95 rel_p99   |F - exact| / exact          rms max   |F - exact|
//   macs              multiply-adds of the network, mean over all pairs: far pairs skip it
//   m0_instructions   Cortex-M0, one pair by itself; m0_shot: a shot of the cube. Counted, not
//   timed.
#include <array>

#include "fixtures.hpp"
#include "form_factor/closed_form.hpp"
#include "form_factor/gauss.hpp"
#include "form_factor/kernel.hpp"
#include "form_factor/lambert.hpp"
#include "form_factor/reference.hpp"
#include "method/engine_source.hpp"
#include "urad/cheapest.hpp"
#include "urad/form_factor.hpp"
#include "urad/hemicube_table.hpp"
#include "urad/legacy.hpp"

namespace {

using fixtures::Errors;
using fixtures::Pair;

constexpr std::array kSets = {"cube", "free", "room"};

void show_counted(benchmark::State& state, const std::string& set, const std::string& method) {
  if (set != "cube" || !fixtures::instructions()) return;  // counted on the cube
  fixtures::show_instructions(state, "m0_instructions", fixtures::instructions()->per_pair(method));
  fixtures::show_instructions(state, "m0_shot", fixtures::instructions()->per_shot(method));
}

/// One row of the table. Run: F of a Pair, inlined into the timed loop. `counted`: its name in the
/// instruction counts.
template <class Run>
void add_row(const std::string& set, const std::string& method, const std::string& counted,
             Run run) {
  const auto row = [=, known = std::make_shared<std::optional<Errors>>(),
                    macs = std::make_shared<double>()](benchmark::State& state) mutable {
    const std::vector<Pair>& pairs = fixtures::pair_set(set).pairs;
    if (!*known) {  // the library calls this several times for one row
      std::vector<double> factors;
      factors.reserve(pairs.size());
      for (const Pair& pair : pairs) {
        if constexpr (requires { run.estimated(pair); }) {
          factors.push_back(run.estimated(pair));
        } else {
          factors.push_back(run(pair));
        }
      }
      *known = fixtures::errors(pairs, factors);
      if constexpr (requires { run.macs(); }) *macs = run.macs();
    }
    std::size_t k = 0;
    for (auto _ : state) {
      benchmark::DoNotOptimize(run(pairs[k]));
      if (++k == pairs.size()) k = 0;
    }
    fixtures::show(state, **known);
    if (*macs > 0) state.counters["macs"] = *macs;
    show_counted(state, set, counted);
  };
  benchmark::RegisterBenchmark(("pair/" + set + "/" + method).c_str(), row);
}

/// The truth of all other rows; its own errors are what it estimates of itself.
struct Reference {
  double operator()(const Pair& pair) const { return host::reference_estimate(*pair.p, *pair.q).f; }
  double estimated(const Pair& pair) const {
    return pair.exact * (1 + host::reference_estimate(*pair.p, *pair.q).relative_error);
  }
};

/// The engine's integers, from the numbers of two patches to F.
class InEngine {
 public:
  InEngine(urad::Kernel kernel, const urad_net* net) : kernel_(kernel), net_(net) {}

  double operator()(const Pair& pair) {
    const urad_scene& scene = pair.scene->pod();
    const urad::Patch i = urad::patch_at(scene, pair.i), j = urad::patch_at(scene, pair.j);
    const std::int32_t log2_g_q24 =
        urad::exchange_log2_q24(scene, i, j, kernel_, net_, 0, &counters_);
    return urad::form_factor_uq32(log2_g_q24, i.shape->log2_area_q24) * 0x1p-32;
  }
  double macs() const {
    if (!net_) return 0;
    const double near = counters_.evaluated - counters_.far_pairs,
                 all = counters_.evaluated + counters_.skipped_facing;
    return near / all * (net_->hidden * (net_->inputs + 1) + net_->inputs);
  }

 private:
  urad::Kernel kernel_;
  const urad_net* net_;
  urad_counters counters_{};
};

/// The cheapest way that is accurate enough, with the shipped general network.
class Auto {
 public:
  explicit Auto(const std::string& method)
      : log2_error_q8_(host::auto_error_q8(host::parse_method(method))) {}

  double operator()(const Pair& pair) {
    const urad_scene& scene = pair.scene->pod();
    const urad::Patch i = urad::patch_at(scene, pair.i), j = urad::patch_at(scene, pair.j);
    const urad::CheapestPair found =
        urad::cheapest_exchange(scene, i, j, net_, log2_error_q8_, &counters_);
    return urad::form_factor_uq32(found.log2_exchange_q24, i.shape->log2_area_q24) * 0x1p-32;
  }

 private:
  std::int16_t log2_error_q8_;
  const urad_net* net_ = &fixtures::nets().find("general");
  urad_counters counters_{};
};

/// A network of the 1996 report, one pair by itself; the scene's box is its unit cube.
class Legacy {
 public:
  explicit Legacy(const std::string& name) : net_(fixtures::nets().find_legacy(name)) {}

  double operator()(const Pair& pair) {
    const urad_scene& scene = pair.scene->pod();
    const auto surface = urad::patch_at(scene, pair.j).surface - scene.surface;
    memory_.resize(urad::legacy_bytes(net_.hidden) / sizeof(std::int32_t));
    urad::LegacySource source{&scene, &net_, 0, 0xFFFF, &counters_, memory_.data()};
    std::uint32_t f_uq32 = 0;
    urad::legacy_fill(&source, pair.i, std::uint16_t(surface), pair.j, 1, &f_uq32);
    return f_uq32 * 0x1p-32;
  }
  double macs() const { return net_.hidden * (URAD_LEGACY_INPUTS + 1); }

 private:
  const urad_legacy_net& net_;
  std::vector<std::int32_t> memory_;
  urad_counters counters_{};
};

/// Turned hemicubes at the centres of patches. Memory and tables are made once.
template <int R>
class Hemicube {
 public:
  Hemicube() : cells_(urad::make_hemicube_table<R>()) {}

  /// Factors of one shooter, [patch_count] UQ0.32. An item buffer is used unless the scene is
  /// convex.
  const std::uint32_t* row(const urad_scene& scene, std::uint16_t shooter) {
    const std::uint16_t rows = scene.flags & URAD_SCENE_CONVEX ? 0 : R;
    memory_.resize(urad::hemicube_bytes(R, rows, scene.patch_count, false) / 4 + 1);
    if (urad::hemicube_init(&source_, &scene, urad::hemicube_table(cells_), rows,
                            urad::hemicube_turned, memory_.data(), memory_.size() * 4,
                            &counters_) != urad::Status::ok ||
        urad::hemicube_render(&source_, shooter) != urad::Status::ok) {
      std::abort();  // tables and memory are ours
    }
    return source_.visible_uq32;
  }
  double operator()(const Pair& pair) { return row(pair.scene->pod(), pair.i)[pair.j] * 0x1p-32; }

 private:
  urad::HemicubeCells<R> cells_;
  std::vector<std::uint32_t> memory_;
  urad_counters counters_{};
  urad::HemicubeSource source_{};
};

/// A hemicube serves all receivers of a shooter: on the cube its time is shared by the 245 patches
/// of other walls.
template <int R>
void add_shared_hemicube(const std::string& method) {
  const auto row = [=, known = std::make_shared<std::optional<Errors>>()](benchmark::State& state) {
    const std::vector<Pair>& pairs = fixtures::pair_set("cube").pairs;
    const urad_scene& scene = pairs.front().scene->pod();
    Hemicube<R> hemicube;
    if (!*known) {
      std::vector<std::vector<std::uint32_t>> rows(scene.patch_count);
      for (std::uint16_t i = 0; i < scene.patch_count; ++i) {
        const std::uint32_t* f_uq32 = hemicube.row(scene, i);
        rows[i].assign(f_uq32, f_uq32 + scene.patch_count);
      }
      std::vector<double> factors;
      factors.reserve(pairs.size());
      for (const Pair& pair : pairs) factors.push_back(rows[pair.i][pair.j] * 0x1p-32);
      *known = fixtures::errors(pairs, factors);
    }
    const auto receivers = benchmark::IterationCount(pairs.size() / scene.patch_count);
    std::uint16_t shooter = 0;
    while (state.KeepRunningBatch(receivers)) {
      benchmark::DoNotOptimize(hemicube.row(scene, shooter));
      benchmark::ClobberMemory();
      if (++shooter == scene.patch_count) shooter = 0;
    }
    fixtures::show(state, **known);
    show_counted(state, "cube", method);
  };
  benchmark::RegisterBenchmark(("pair/cube/" + method).c_str(), row);
}

/// A network of the 1996 report on the cube it was trained on, whole rows at a time as a solver
/// asks for them: what a shooter and a wall share is paid once.
void add_legacy_rows(const std::string& name) {
  const std::string method = "legacy:" + name;
  const auto row = [=, known = std::make_shared<std::optional<Errors>>()](benchmark::State& state) {
    const std::vector<Pair>& pairs = fixtures::pair_set("cube").pairs;
    const host::EngineSource source(*pairs.front().scene, host::parse_method(method),
                                    fixtures::nets(), {});
    const std::uint16_t patches = pairs.front().scene->pod().patch_count;
    std::vector<std::uint32_t> f_uq32(patches);
    if (!*known) {
      std::vector<std::vector<std::uint32_t>> rows(patches, f_uq32);
      for (std::uint16_t i = 0; i < patches; ++i) source.row(i, rows[i].data());
      std::vector<double> factors;
      factors.reserve(pairs.size());
      for (const Pair& pair : pairs) factors.push_back(rows[pair.i][pair.j] * 0x1p-32);
      *known = fixtures::errors(pairs, factors);
    }
    const auto receivers = benchmark::IterationCount(pairs.size() / patches);
    std::uint16_t shooter = 0;
    while (state.KeepRunningBatch(receivers)) {
      source.row(shooter, f_uq32.data());
      benchmark::ClobberMemory();
      if (++shooter == patches) shooter = 0;
    }
    fixtures::show(state, **known);
  };
  benchmark::RegisterBenchmark(("pair/cube/" + method).c_str(), row);
}

template <host::Estimate (*estimate)(const host::Polygon&, const host::Polygon&)>
double in_double(const Pair& pair) {
  return estimate(*pair.p, *pair.q).f;
}
template <host::Estimate (*estimate)(const host::Polygon&, const host::Polygon&, int), int n>
double in_double(const Pair& pair) {
  return estimate(*pair.p, *pair.q, n).f;
}

const bool added = [] {
  for (const std::string set : kSets) {
    add_row(set, "reference", "", Reference());
    add_row(set, "closed-form", "",
            [](const Pair& pair) { return host::closed_form(*pair.p, *pair.q).f; });
    add_row(set, "lambert:1", "", in_double<host::lambert_estimate, 1>);
    add_row(set, "lambert:2", "", in_double<host::lambert_estimate, 2>);
    add_row(set, "lambert:3", "", in_double<host::lambert_estimate, 3>);
    add_row(set, "gauss:2", "", in_double<host::gauss_estimate, 2>);
    add_row(set, "gauss:4", "", in_double<host::gauss_estimate, 4>);
    add_row(set, "kernel", "", in_double<host::centre_kernel_estimate>);
    add_row(set, "moment", "", in_double<host::moment_kernel_estimate>);
    add_row(set, "fixed-kernel", "fixed-kernel", InEngine(urad::Kernel::centre, nullptr));
    add_row(set, "fixed-moment", "fixed-moment", InEngine(urad::Kernel::moment, nullptr));
    add_row(set, "net:general", "",
            InEngine(urad::Kernel::moment, &fixtures::nets().find("general")));
    add_row(set, "net:cube7", "net",
            InEngine(urad::Kernel::moment, &fixtures::nets().find("cube7")));
    for (const char* method : {"auto:0.1", "auto", "auto:0.001"})
      add_row(set, method, method, Auto(method));
    if (set == "cube") {
      add_shared_hemicube<32>("hemicube:32");
      add_shared_hemicube<64>("hemicube:64");
      for (const char* name :
           {"linear50", "linear30", "linear15", "linear5", "log30", "log15", "log5"})
        add_legacy_rows(name);
    } else {
      add_row(set, "hemicube:32", "", Hemicube<32>());
      add_row(set, "hemicube:64", "", Hemicube<64>());
      add_row(set, "legacy:linear50", "", Legacy("linear50"));
    }
  }
  return true;
}();

}  // namespace
