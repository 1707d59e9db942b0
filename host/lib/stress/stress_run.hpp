// Attacks until time is up.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "stress/attacks.hpp"
#include "stress/case_file.hpp"

namespace host {

struct StressRequest {
  std::string command;             ///< goes into the document
  std::vector<std::string> kinds;  ///< of stress_kinds()
  std::uint64_t seed = 1;
  double minutes = 1;     ///< for all kinds together
  std::size_t cases = 0;  ///< of each family, instead of a time; 0: by time
  std::string folder;     ///< failures go here; empty: nowhere
  NetChoice nets;
  int threads = 0;
  bool quiet = false;
};

/// One check of one family over the whole run.
struct StressRow {
  std::string kind, family, what;
  std::uint64_t cases = 0, failures = 0;
  double worst = 0, limit = 0, sum = 0;
  std::uint64_t where = 0;  ///< the case of the worst value
  bool holds() const { return failures == 0; }
};

struct StressReport {
  StressRequest request;
  std::vector<StressRow> rows;            ///< by kind and family, in order of first appearance
  std::vector<std::uint64_t> kind_cases;  ///< as request.kinds
  std::vector<std::string> files;         ///< failures written
  double seconds = 0;
  std::uint64_t failures() const;
};

/// Case number `index` of a family: the same for the same seed on any number of threads.
StressCase stress_case(const Attack& attack, std::uint64_t seed, std::uint64_t index);

/// Runs them on all threads. The first failures of every check are written to the folder; a case
/// that ends the program, or does not end, is written there as well. Throws Error when the folder
/// cannot be written.
StressReport run_stress(const StressRequest& request);

/// The checks of one case again.
std::vector<StressCheck> replay(const StressCase& stress_case, const NetChoice& nets);

}  // namespace host
