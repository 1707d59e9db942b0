// --net FILE: a network of the user's beside the shipped ones.
#pragma once
#include <memory>
#include <string>

#include "base/file.hpp"
#include "command.hpp"
#include "legacy/legacy_json.hpp"
#include "network/net_json.hpp"

namespace tool {

/// The shipped networks and, when `path` is not empty, the 16-bit network of that file. Throws
/// host::Error.
class Nets {
 public:
  explicit Nets(const std::string& path) : choice_{shipped_net, nullptr, shipped_legacy_net} {
    if (path.empty()) return;
    const std::string text = host::read_file(path);
    if (host::is_legacy_json(text)) {
      legacy_ = std::make_unique<host::LegacyFixed>(host::legacy_from_json(text, path).fixed);
      choice_.legacy_file = &legacy_->pod();
      return;
    }
    file_ = std::make_unique<host::NetFile>(host::net_from_json(text, path));
    choice_.file = &file_->quantised(16).pod();
  }
  const host::NetChoice& choice() const { return choice_; }
  const host::NetFile* file() const { return file_.get(); }

 private:
  std::unique_ptr<host::NetFile> file_;
  std::unique_ptr<host::LegacyFixed> legacy_;
  host::NetChoice choice_;
};

}  // namespace tool
