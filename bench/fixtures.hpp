// What the benchmarks share: networks, scenes, pairs with their exact factors, and errors of a
// method on them.
#pragma once
#include <benchmark/benchmark.h>

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "method/nets.hpp"
#include "report/instructions.hpp"
#include "scene/fixed_scene.hpp"
#include "scene/scene.hpp"
#include "solve/scene_solver.hpp"

namespace fixtures {

/// The shipped networks: "general", "cube7" and "cornell", and the report's seven.
const host::NetChoice& nets();

/// One ordered pair, as the host's methods take it and as the engine does, with its factor by the
/// reference.
struct Pair {
  const host::Polygon *p, *q;
  const host::FixedScene* scene;
  std::uint16_t i, j;  ///< their numbers in `scene`
  double exact;
};

/// Pairs in random order (fixed seed), so that the first thousand stand for all. Owns what they
/// point to.
struct PairSet {
  std::deque<host::Scene> scenes;
  std::deque<host::Polygon> polygons;
  std::deque<host::FixedScene> fixed;
  std::vector<Pair> pairs;
};

/// "cube": the 72,030 ordered pairs of cube7 on different walls. "free": two quads anywhere in the
/// unit cube, each a random walk in a random plane, each wholly in front of the other [Martin 1996,
/// section 3.2], a thousand in each of the decades 1e-6..1e-4, ..1e-3, ..1e-2, ..1e-1, ..1. "room":
/// 5,000 pairs of patches of meshed rooms. No network was trained on these two. Made at the first
/// call.
const PairSet& pair_set(const std::string& name);

/// A built-in scene with its exact solution, made at the first call.
host::SceneSolver& solver(const std::string& scene);

struct Errors {
  double median, p95, p99;  ///< relative, of pairs with light
  double rms, max;          ///< absolute
};
Errors errors(const std::vector<Pair>& pairs, const std::vector<double>& factors);

/// Counters rel_median, rel_p95, rel_p99, rms, max.
void show(benchmark::State& state, const Errors& errors);

/// Counted Cortex-M0 instructions (bench/icount/run.sh): the file named by URAD_ICOUNT, else
/// build/icount.json; nothing when there is no such file.
const std::optional<host::InstructionCounts>& instructions();

/// Counter m0_instructions or m0_shot, where counted.
void show_instructions(benchmark::State& state, const char* counter, std::optional<double> count);

}  // namespace fixtures
