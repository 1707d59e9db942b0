#include "method/nets.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace host {

const urad_net& NetChoice::find(const std::string& name) const {
  if (name.empty() && file) return *file;
  const std::string wanted = name.empty() ? "general" : name;
  const urad_net* net = shipped ? shipped(wanted) : nullptr;
  if (!net) {
    throw UsageError(fmt::format(
        "net:{}: there is no shipped network of that name; train one and give its file with --net",
        wanted));
  }
  return *net;
}

const urad_net* NetChoice::general() const {
  if (file) return file;
  return shipped ? shipped("general") : nullptr;
}

}  // namespace host
