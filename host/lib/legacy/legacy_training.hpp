// Several of the report's networks at once, each on a core, with files to go on from.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "legacy/legacy_json.hpp"

namespace host {

struct LegacyJob {
  std::string file;  ///< name without folder and ending: "linear50"
  std::string
      command;  ///< goes into the file; a finished or unfinished file of another is replaced
  std::string subject;
  BackpropSettings settings;
  const LegacySplit* data = nullptr;
  std::function<LegacyErrors(const LegacyFixed&)> measure;  ///< of the integers; may be empty
};

/// Trains what `folder` (made if missing) does not hold yet: NAME.json when done, NAME.json.partial
/// every few seconds on the way. Interrupted at any time, the next call goes on from there and ends
/// with the same bits. In the order of `jobs`, on `threads` cores (0: all).
std::vector<LegacyNetFile> train_legacy(const std::vector<LegacyJob>& jobs,
                                        const std::string& folder, int threads, bool quiet);

}  // namespace host
