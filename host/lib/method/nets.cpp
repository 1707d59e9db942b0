#include "method/nets.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace host {

const urad_net& NetChoice::find(const std::string& name) const {
  if (name.empty() && file) return *file;
  if (name.empty() && legacy_file)
    throw UsageError(
        "the file of --net holds a network of the 1996 report: --method legacy would do");
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

const urad_legacy_net& NetChoice::find_legacy(const std::string& name) const {
  if (name.empty() && legacy_file) return *legacy_file;
  const urad_legacy_net* net = shipped_legacy && !name.empty() ? shipped_legacy(name) : nullptr;
  if (!net) {
    throw UsageError(fmt::format(
        "legacy:{}: there is no shipped network of that name; linear50, linear30, linear15, "
        "linear5, "
        "log30, log15 and log5 are, and `legacy` takes a file of urad reproduce with --net",
        name));
  }
  return *net;
}

}  // namespace host
