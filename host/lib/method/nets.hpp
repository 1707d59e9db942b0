// Which network a method means: a shipped one by name, or a file.
#pragma once
#include <functional>
#include <string>

#include "urad/legacy_net.h"
#include "urad/net.h"

namespace host {

/// Finds a shipped network by name; null when there is none. The library itself knows no weights: a
/// program that has some hands this in.
using NetLookup = std::function<const urad_net*(const std::string& name)>;

/// The same for the networks of the report, by their names without "legacy_".
using LegacyLookup = std::function<const urad_legacy_net*(const std::string& name)>;

/// Shipped networks and the file of --net, if any.
struct NetChoice {
  NetLookup shipped;
  const urad_net* file = nullptr;
  LegacyLookup shipped_legacy = {};
  const urad_legacy_net* legacy_file = nullptr;

  /// `net:NAME` is the shipped NAME; `net` is the file of --net or else the general network. Throws
  /// Error.
  const urad_net& find(const std::string& name) const;
  /// The net that serves any scene: the file of --net, the shipped general one, or null.
  const urad_net* general() const;
  /// `legacy:NAME` is the report's shipped NAME ("linear50"); `legacy` is the file of --net. Throws
  /// Error.
  const urad_legacy_net& find_legacy(const std::string& name) const;
};

}  // namespace host
