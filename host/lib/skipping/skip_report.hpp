// What every skip leaves out in a scene, what that saves on a Cortex-M0, and how early the light can
// be shown.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "method/engine_source.hpp"
#include "solve/pair_statistics.hpp"

namespace host {

/// Shots until the error of what is shown falls to 10, 5, 2 and 1 % of the converged light; 0: not
/// reached.
struct EarlyAnswer {
  std::string name;
  int shots[4] = {0, 0, 0, 0};
  std::vector<double> errors;  ///< of what is shown before each shot, down to 1 %
};
inline constexpr double kEarlyErrors[4] = {0.1, 0.05, 0.02, 0.01};

/// The smallest object of a scene moves half the way that it has free: shots until the light is within
/// kEarlyErrors of that of a solve from the start, and what such a solve takes.
struct MovedAnswer {
  std::size_t patches = 0;  ///< of the object
  std::uint32_t made = 0;   ///< pairs asked for again, both looks
  std::size_t pairs = 0;    ///< in two looks at all
  double before = 0;        ///< error of the light as it was
  int shots[4] = {0, 0, 0, 0}, from_start[4] = {0, 0, 0, 0};
};

struct SkipReport {
  std::string scene;
  std::size_t patches = 0, blockers = 0;
  PairStatistics pairs;
  urad_counters by_pairs{};   ///< one sweep of the network with rays
  urad_counters bounded{};    ///< the same with bounded contribution
  urad_counters by_hybrid{};  ///< one sweep of hybrid:64
  std::vector<EarlyAnswer> early;
  std::vector<double> by_number;               ///< errors without any of it: patches shoot in turn
  double error_few = 0;                        ///< rms of B, 16 rays a pair
  double error_fixed = 0, error_worth = 0;     ///< rms of B, 64 rays a pair and 64 by worth
  double error_bits = 0, error_fractions = 0;  ///< rms of B by exported visibility
  std::size_t bytes_bits = 0, bytes_fractions = 0;
  std::optional<MovedAnswer> moved;  ///< of scenes with something that can stand between patches
  /// Mean instructions of a row by "on", "same", ..., "all", "bounded", "on_64", "all_64", "worth_64", and of a shot's solver by
  /// "solver_on", "solver_all"; of a row with exported fractions "sight"; of light_mix() with one light
  /// and with two "light_1", "light_2"; empty: not counted.
  std::map<std::string, double> instructions;
};

inline constexpr int kSkipRays = 16;            ///< as in firmware_style/ports/skips_main.cpp
inline constexpr double kSkipBound = 1.0 / 64;  ///< the same; also where rays by worth get fewer
inline constexpr int kManyRays = 64;

/// Sweeps and solves. `counted`: folder of SCENE.json, and SCENE.sight.json for occluded scenes with
/// exported fractions, of bench/icount with PROGRAM=skips, or empty. Throws Error when a file is not of
/// the form.
SkipReport skip_report(const std::string& scene, const NetChoice& nets, const std::string& counted,
                       int threads);

/// docs/SKIPPING.md. `chart`: file name STEM.svg of the bar chart beside it; each early_chart() is
/// STEM_SCENE.svg.
std::string skip_document(const std::vector<SkipReport>& reports, const std::string& command,
                          const std::string& chart);

/// Error of what is shown against instructions counted for a shot (against shots where none are).
std::string early_chart(const SkipReport& report);

/// Bars of pairs by what became of them, a scene each.
std::string skip_chart(const std::vector<SkipReport>& reports);

}  // namespace host
