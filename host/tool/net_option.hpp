// --net FILE: a network of the user's beside the shipped ones.
#pragma once
#include <memory>
#include <string>

#include "command.hpp"
#include "network/net_json.hpp"

namespace tool {

/// The shipped networks and, when `path` is not empty, the 16-bit network of that file. Throws
/// host::Error.
class Nets {
 public:
  explicit Nets(const std::string& path) : choice_{shipped_net} {
    if (path.empty()) return;
    file_ = std::make_unique<host::NetFile>(host::read_net(path));
    choice_.file = &file_->quantised(16).pod();
  }
  const host::NetChoice& choice() const { return choice_; }
  const host::NetFile* file() const { return file_.get(); }

 private:
  std::unique_ptr<host::NetFile> file_;
  host::NetChoice choice_;
};

}  // namespace tool
