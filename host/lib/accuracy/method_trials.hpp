// Every method on every kind of pair: error by kind and by decade of F, cost in the same row, and
// how far an estimate of the error can be trusted.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "accuracy/method_table.hpp"
#include "accuracy/trial_pairs.hpp"
#include "report/instructions.hpp"
#include "urad/cheapest.hpp"

namespace host {

struct TrialRequest {
  std::vector<TableMethod> methods;
  std::uint64_t seed = 20240229;
  std::size_t pairs = 1000;                         ///< of each family, stream TrialUse::test
  const InstructionCounts* instructions = nullptr;  ///< or null: no such column
  int threads = 0;
};

/// How an estimate of the relative error fares: errors above it, and it by the error.
struct EstimateRow {
  double missed = 0;  ///< share of pairs whose error is above the estimate
  double median = 0, p90 = 0;
};

struct MethodTrialRow {
  std::string label;
  std::size_t pairs = 0;
  double median = 0, p95 = 0, p99 = 0, max = 0;       ///< |F - exact| / exact
  double bias = 0;                                    ///< mean of (F - exact) / exact
  double ns = 0;                                      ///< a pair, host, one core
  std::optional<double> multiply_adds, instructions;  ///< a pair; by the formula of each method
  std::optional<EstimateRow> estimate;                ///< of methods that know their error
};

struct MethodTrialTable {
  std::string title;
  std::vector<MethodTrialRow> rows;
};

struct MethodTrials {
  std::vector<MethodTrialTable> families, decades;
  std::vector<std::string> ways;  ///< share of the ways that auto took, a line a family and setting
};

/// Multiply-adds of what auto did for a pair, its guesses included. net: the one it may have run.
double auto_multiply_adds(const urad::CheapestPair& pair, const urad_net* net);

/// Times one method after the other on one core; exact factors on all cores.
MethodTrials try_methods(const TrialRequest& request);

/// Markdown: a table a family, then a table a decade, then the ways of auto.
std::string to_markdown(const MethodTrials& trials);

/// The methods of `urad evaluate` when none are named: all that are cheap enough, auto at three
/// errors. A method that needs a network is left out where there is none.
std::vector<TableMethod> trial_methods(const NetChoice& nets);

}  // namespace host
