// Counted Cortex-M0 instructions, as bench/icount writes them, by method.
#pragma once
#include <optional>
#include <string>

namespace host {

/// {board: {what: {"mean": ...}}}; asked for the micro:bit's Cortex-M0.
class InstructionCounts {
 public:
  /// Throws Error when the file cannot be read or is not of that form.
  explicit InstructionCounts(const std::string& path);
  ~InstructionCounts();

  /// One pair, one shot of the cube by this method; nothing where it was not counted.
  std::optional<double> per_pair(const std::string& method) const;
  /// One point of an exact sum over a square patch, all it takes beside the point included.
  std::optional<double> per_point() const { return mean("pair_point"); }
  std::optional<double> per_shot(const std::string& method) const;

 private:
  std::optional<double> mean(const std::string& what) const;
  std::string text_;
};

}  // namespace host
