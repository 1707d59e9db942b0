// net.json: a trained network with all that is needed to judge it, resume from it and export it.
#pragma once
#include <string>
#include <vector>

#include "network/error_table.hpp"
#include "network/float_net.hpp"
#include "network/quantised_net.hpp"

namespace host {

struct NetFile {
  std::string command;  ///< that trained it
  std::string subject;  ///< name of the scene, or "general"
  std::string split;    ///< what was trained on and what was held out, in words
  std::uint64_t seed = 1;
  double far_rho = 0;  ///< pairs below it take the kernel alone
  FloatNet net;
  QuantisedNet quantised16, quantised8;
  std::vector<ErrorRow>
      errors;  ///< "train", "held_out", "int16", "int8", ... against the reference

  /// Null when there is no such row.
  const ErrorRow* error(const std::string& name) const;
  /// Throws Error unless bits is 8 or 16.
  const QuantisedNet& quantised(int bits) const;
};

/// The bytes of net.json: the same for the same file, whichever compiler built the program.
std::string to_json(const NetFile& file);

/// `where` names the text in messages. Error when it is cut short, of another version, or a field
/// is missing, of the wrong length, not a number or out of range.
NetFile net_from_json(const std::string& text, const std::string& where);

/// Reads the file. Throws Error.
NetFile read_net(const std::string& path);

}  // namespace host
