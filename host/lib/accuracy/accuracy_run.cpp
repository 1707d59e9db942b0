#include "accuracy/accuracy_run.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/progress.hpp"
#include "network/evaluate.hpp"
#include "network/train_net.hpp"
#include "scene/builtin.hpp"

namespace host {

namespace {

constexpr int kHemicube = 64, kNearHemicube = 32, kCornellHybrid = 64;
constexpr int kTruthRays = 1024;
constexpr const char* kBoard = "microbit";

TrainRequest training(const AccuracyRequest& request, int hidden, std::uint64_t seed) {
  TrainRequest train;
  train.hidden = hidden;
  train.seed = seed;
  train.threads = request.threads;
  return train;
}

NetFile scene_net(const AccuracyRequest& request, const Scene& scene, std::uint64_t seed) {
  return train_scene_net(scene, training(request, request.scene_hidden, seed)).value();
}

/// The general networks of the run, with what to call them.
struct GeneralNet {
  std::string origin;
  const urad_net* pod = nullptr;
  std::optional<NetFile> file;
};

GeneralNet general_net(const AccuracyRequest& request, std::uint64_t seed) {
  GeneralNet net{fmt::format("seed {}", seed), nullptr,
                 train_general_net(training(request, request.general_hidden, seed)).value()};
  net.pod = &net.file->quantised16.pod();  // shared by copies of the file
  return net;
}

void check_reference(const AccuracyRequest& request, SceneSolver& cube7, AccuracyResults* results) {
  results->known = check_known_values(known_values());
  results->cube_rows = check_rows(cube7.exact().form_factors);
  results->hostile = check_degenerate(request.pair_seed, request.pairs, request.threads);
  results->scales = check_scales(request.pair_seed, request.pairs / 10 + 1, request.threads);
  results->closed_form = check_closed_form(request.pair_seed, 10 * request.pairs, request.threads);
  results->closed_form.push_back(
      check_closed_form(cube7.scene(), cube7.exact().form_factors, request.threads));
  results->squares = check_occluded(known_square_obstructions(), request.threads);
  results->l_room = check_occluded(known_l_room(), request.threads);
}

void try_general(const GeneralNet& net, const SceneDataset& dataset, SceneSolver& cube7,
                 AccuracyResults* results) {
  const TableMethod method{net.origin, {"net", ""}, {{}, net.pod}};
  GeneralTrial trial;
  trial.origin = net.origin;
  trial.cube7 = measure_scene(cube7.scene(), dataset, {method}).front().row.errors;
  const auto take = [&](const char* part, std::optional<ErrorRow>* into) {
    const ErrorRow* row = net.file ? net.file->error(part) : nullptr;
    if (row) *into = *row;
  };
  take("train", &trial.train);
  take("held_out", &trial.held_out);
  take("int16", &trial.int16);
  take("int8", &trial.int8);
  trial.near_hybrid = light_by_near_hybrid(cube7, *net.pod, kNearHemicube);
  results->general.push_back(trial);
}

void try_cornell(SceneSolver& cornell, const urad_net* general, AccuracyResults* results,
                 Progress* progress) {
  const AccuracyRequest& request = results->request;
  const MethodSpec hybrid{"hybrid", std::to_string(kCornellHybrid)};
  const auto light = [&](const urad_net* net) {
    return cornell.run(hybrid, {{}, net}, converged(cornell.scene())).rms;
  };
  for (const std::uint64_t seed : request.seeds) {
    CornellTrial trial{try_scene_net(cornell, scene_net(request, cornell.scene(), seed)), 0};
    trial.light = light(&trial.net.net.quantised16.pod());
    results->cornell.push_back(std::move(trial));
    progress->add();
  }
  results->cornell_general = light(general);
}

std::vector<TableMethod> table_methods(const urad_net* general, const urad_net* own,
                                       const LegacyLookup& legacy) {
  std::vector<TableMethod> methods;
  for (const char* text : {"reference", "closed-form", "kernel", "moment", "lambert:1", "lambert:2",
                           "lambert:3", "gauss:2", "gauss:4", "contour:2", "contour:4",
                           "hemicube:64", "hemicube:128", "fixed-kernel", "fixed-moment"})
    methods.push_back({text, parse_method(text), {}});
  methods.push_back({"auto", {"auto", ""}, {{}, general}});
  methods.push_back({"net, general", {"net", ""}, {{}, general}});
  methods.push_back({"net, of cube7", {"net", ""}, {{}, own}});
  methods.push_back({"legacy:linear50", {"legacy", "linear50"}, {{}, nullptr, legacy}});
  return methods;
}

void measure_methods(const AccuracyRequest& request, const SceneDataset& dataset,
                     const Scene& cube7, const std::vector<TableMethod>& methods,
                     AccuracyResults* results) {
  results->cube7_methods = measure_scene(cube7, dataset, methods);
  const auto table = [&](const PairSet& set) {
    return MethodTable{fmt::format("{}, {} pairs", set.name, set.pairs.size()),
                       measure_pairs(set, methods)};
  };
  const std::vector<PairSet> quads =
      free_quads_by_decade(request.pair_seed, request.pairs, request.threads);
  for (const PairSet& set : quads) results->free_quads.push_back(table(set));
  for (const bool concave : {false, true})
    results->free_quads.push_back(table(concave_part(quads, concave)));
  results->rooms = table(room_pairs(request.pair_seed, 5 * request.pairs, request.threads));
}

/// The kinds of pairs, and the light of cube7 by auto with the general net.
void try_kinds(const AccuracyRequest& request, const urad_net* general, SceneSolver& cube7,
               AccuracyResults* results) {
  const NetChoice nets{{}, general};
  TrialRequest trials;
  trials.methods = {{"auto", {"auto", ""}, nets}};
  trials.seed = request.pair_seed;
  trials.pairs = request.pairs / 2;
  trials.threads = request.threads;
  std::optional<InstructionCounts> counts;
  if (!request.instructions.empty()) trials.instructions = &counts.emplace(request.instructions);
  results->trials = try_methods(trials);
  const MethodRun run = cube7.run({"auto", ""}, nets, converged(cube7.scene()));
  results->auto_light = run.rms;
  results->auto_light_max = run.max;
}

void read_instructions(const std::string& path, AccuracyResults* results) {
  const auto json = nlohmann::json::parse(read_file(path), nullptr, false);
  if (json.is_discarded() || !json.is_object() || !json.contains(kBoard))
    throw Error(path + ": not a table of counted instructions; bench/icount/run.sh writes one");
  const auto mean = [&](const char* what) {
    const auto& board = json.at(kBoard);
    return board.contains(what) ? std::optional<double>(board.at(what).at("mean").get<double>())
                                : std::nullopt;
  };
  results->solve_instructions = mean("solve_network");
  results->pair_instructions = mean("pair_network");
  results->shot_instructions = mean("shot_network");
}

}  // namespace

AccuracyResults run_accuracy(const AccuracyRequest& request) {
  AccuracyResults results;
  results.request = request;
  if (!request.instructions.empty()) read_instructions(request.instructions, &results);
  const std::size_t generals = std::max<std::size_t>(1, request.general_seeds.size());
  Progress progress("accuracy", 3 + 2 * request.seeds.size() + generals, request.quiet);

  const Scene cube_scene = load_scene("cube7"), cornell_scene = load_scene("cornell");
  SceneSolver cube7(cube_scene, request.threads, true, kTruthRays);
  SceneSolver cornell(cornell_scene, request.threads, true, kTruthRays);
  const FixedScene fixed(cube_scene);
  const SceneDataset dataset =
      scene_dataset(cube_scene, fixed, TrainRequest().far_rho, 1, 400000, request.threads);

  check_reference(request, cube7, &results);
  results.hemicube = try_hemicube(cube7, kHemicube, request.threads);
  progress.add();

  for (const std::uint64_t seed : request.seeds) {
    results.cube7.push_back(try_scene_net(cube7, scene_net(request, cube_scene, seed)));
    const QuantisedNet& net = results.cube7.back().net.quantised16;
    results.chip.push_back(solve_like_a_chip(cube7, net));
    results.near_hybrid.push_back(light_by_near_hybrid(cube7, net.pod(), kNearHemicube));
    progress.add();
  }

  std::vector<GeneralNet> generals_of_run;
  if (request.general_seeds.empty()) {
    generals_of_run.push_back({"shipped", &NetChoice{request.shipped}.find("general"), {}});
    progress.add();
  }
  for (const std::uint64_t seed : request.general_seeds) {
    generals_of_run.push_back(general_net(request, seed));
    progress.add();
  }
  for (const GeneralNet& net : generals_of_run) try_general(net, dataset, cube7, &results);
  const urad_net* general = generals_of_run.front().pod;

  try_cornell(cornell, general, &results, &progress);
  progress.add();

  measure_methods(
      request, dataset, cube_scene,
      table_methods(general, &results.cube7.front().net.quantised16.pod(), request.shipped_legacy),
      &results);
  try_kinds(request, general, cube7, &results);
  progress.add();
  return results;
}

}  // namespace host
