// The state of an unfinished training as a file beside its output.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "network/trainer.hpp"

namespace host {

/// Where a command with several trainings in a row stands.
struct Checkpoint {
  std::string command;                        ///< a file of another command is of no use
  std::vector<std::vector<double>> finished;  ///< parameters of the nets that are done
  TrainerState state;                         ///< of the one in work
};

/// Doubles survive exactly.
std::string to_json(const Checkpoint& checkpoint);

/// Nothing when the text is none of ours or belongs to another command: training then starts from
/// the beginning. Throws Error, which begins with `where`, when it has been altered since it was
/// written.
std::optional<Checkpoint> checkpoint_from_json(const std::string& text, const std::string& command,
                                               const std::string& where);

}  // namespace host
