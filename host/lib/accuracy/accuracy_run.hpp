// Everything docs/ACCURACY.md states, measured in one go.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/closed_form_checks.hpp"
#include "accuracy/method_table.hpp"
#include "accuracy/method_trials.hpp"
#include "accuracy/occluded_checks.hpp"
#include "accuracy/reference_checks.hpp"
#include "accuracy/scene_trials.hpp"

namespace host {

struct AccuracyRequest {
  std::string command;  ///< goes into the document
  std::vector<std::uint64_t>
      seeds;  ///< of trainings; the first one's nets go into the tables of methods
  std::vector<std::uint64_t>
      general_seeds;                   ///< of general nets; empty: the shipped general net instead
  std::uint64_t pair_seed = 19960501;  ///< of every set of random pairs
  std::size_t pairs =
      1000;  ///< free quads per decade, draws of each degenerate family; rooms five times that
  int scene_hidden = 4, general_hidden = 8;
  NetLookup shipped;
  LegacyLookup shipped_legacy;
  std::string instructions;  ///< path of icount.json, or empty
  int threads = 0;
  bool quiet = false;
};

/// A general network on a scene that it never saw.
struct GeneralTrial {
  std::string origin;  ///< "seed 3" or "shipped"
  ErrorRow cube7;
  std::optional<ErrorRow> train, held_out;
  std::optional<ErrorRow> int16, int8;  ///< random pairs, none trained on
  double near_hybrid = 0;  ///< light of cube7 by hemicube:32 and this net, see AccuracyResults
};

struct MethodTable {
  std::string title;
  std::vector<MethodRow> rows;
};

/// Light of Cornell's box by hybrid:64 and one network, relative rms.
struct CornellTrial {
  SceneNetTrial net;
  double light = 0;
};

struct AccuracyResults {
  AccuracyRequest request;
  KnownCheck known;
  RowCheck cube_rows;
  std::vector<HostileCheck> hostile;
  ScaleCheck scales;
  std::vector<ClosedFormCheck> closed_form;  ///< the last: cube7
  std::vector<OccludedCheck> squares, l_room;
  std::vector<SceneNetTrial> cube7;
  std::vector<ChipSolve> chip;      ///< by seed
  std::vector<double> near_hybrid;  ///< by seed: light of cube7 by hemicube:32 and its net for
                                    ///< pairs closer than 3 patches
  std::vector<CornellTrial> cornell;
  double cornell_general = 0;  ///< the same light by the first general net
  std::vector<GeneralTrial> general;
  HemicubeTrial hemicube;
  std::vector<SceneMethodRow> cube7_methods;
  std::vector<MethodTable> free_quads;  ///< by decade, then convex, then concave
  MethodTable rooms;
  MethodTrials trials;  ///< auto on every kind of pair, half as many of each as free quads a decade
  double auto_light = 0, auto_light_max = 0;  ///< of cube7, relative rms and greatest error of B
  std::optional<double> solve_instructions, pair_instructions, shot_instructions;
};

/// Trains and measures; minutes. Throws Error.
AccuracyResults run_accuracy(const AccuracyRequest& request);

}  // namespace host
