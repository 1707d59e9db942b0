// What a network might be multiplied with, and what else it might read: the moment kernel with third
// moments, and the sum over 16 pairs of points.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace host {

struct BaseTrialRequest {
  std::vector<std::uint64_t> seeds{1, 2, 3};
  double effort = 1;  ///< share of the pairs and steps
  int threads = 0;
};

/// One way to a factor on pairs of which no training has seen one, none of them cut: of each seed
/// quantiles of |F - exact| / exact. A way without a network has other pairs in each seed.
struct BaseTrial {
  std::string name;
  double multiply_adds = 0;
  std::vector<double> median, p95, p99;  ///< [seed]
};

struct BaseTrials {
  double least_rho = 0, most_rho = 0;
  std::vector<BaseTrial> free_quads, all;  ///< judged on free quads, and on all six families
  std::size_t least_quads = 0;             ///< free quads that were judged, the fewest of the seeds
};

/// For rho of 0.01 to 0.3, where networks are used, and from there to 1, where sums are.
std::vector<BaseTrials> try_bases(const BaseTrialRequest& request);

/// In Markdown, the worst of the seeds.
std::string base_table(const std::vector<BaseTrials>& trials);

}  // namespace host
