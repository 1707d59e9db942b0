// The report's networks as files: finished ones, and trainings that are not.
#pragma once
#include <optional>
#include <string>

#include "legacy/backprop.hpp"
#include "legacy/legacy_fixed.hpp"

namespace host {

/// Errors of F by the integers, on what the net was trained on, against the reference.
struct LegacyErrors {
  double std = 0, bias = 0, p99 = 0;   ///< p99: relative
  double row_mean = 0, row_worst = 0;  ///< |sum of a row - 1|; 0 where there are no rows
};

struct LegacyNetFile {
  std::string command;  ///< that trained it
  std::string subject;  ///< what it was trained on, in words
  std::uint64_t seed = 1;
  int epochs = 0, best_epoch = 0;
  double training_error = 0, validation_error = 0, test_error = 0;  ///< mean squares, scaled
  LegacyNet net;
  LegacyTables fixed;       ///< net, rounded
  LegacyRounding rounding;  ///< what that changed on the training pairs
  LegacyErrors errors;
};

/// Floats survive exactly.
std::string to_json(const LegacyNetFile& file);

/// Whether the text says that it holds such a network (and not one of urad/net.h).
bool is_legacy_json(const std::string& text);

/// `where` names the text in messages. Throws Error for what is cut short, of another version or
/// out of range.
LegacyNetFile legacy_from_json(const std::string& text, const std::string& where);

/// A training that goes on later.
std::string to_json(const BackpropState& state, const std::string& command);
/// Nothing when the text is none of ours or belongs to another command.
std::optional<BackpropState> backprop_from_json(const std::string& text,
                                                const std::string& command);

}  // namespace host
