#include "stress/attacks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.hpp"

namespace host {

std::vector<std::string> stress_kinds() {
  return {"pairs", "networks", "solver", "scenes", "files"};
}

std::vector<Attack> attacks_of(const std::string& kind, const NetChoice& nets) {
  if (kind == "pairs") return pair_attacks(nets);
  if (kind == "networks") return network_attacks(nets);
  if (kind == "solver") return solver_attacks();
  if (kind == "scenes") return scene_attacks(nets);
  if (kind == "files") return file_attacks();
  throw UsageError(
      fmt::format("--kind {}: unknown; known are {}", kind, fmt::join(stress_kinds(), ", ")));
}

}  // namespace host
