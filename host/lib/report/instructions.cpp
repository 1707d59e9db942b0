#include "report/instructions.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"

namespace host {

namespace {

constexpr const char* kBoard = "microbit";

}  // namespace

InstructionCounts::InstructionCounts(const std::string& path) : text_(read_file(path)) {
  const auto json = nlohmann::json::parse(text_, nullptr, false);
  if (json.is_discarded() || !json.is_object() || !json.contains(kBoard)) {
    throw Error(fmt::format(
        "{}: not a table of counted instructions; bench/icount/run.sh writes one", path));
  }
}

InstructionCounts::~InstructionCounts() = default;

std::optional<double> InstructionCounts::mean(const std::string& what) const {
  const auto json = nlohmann::json::parse(text_);
  const auto& board = json.at(kBoard);
  if (what.empty() || !board.contains(what)) return std::nullopt;
  return board.at(what).at("mean").get<double>();
}

std::optional<double> InstructionCounts::per_pair(const std::string& method) const {
  static const std::map<std::string, std::string> names = {{"net", "pair_network"},
                                                           {"fixed-moment", "pair_moment"},
                                                           {"fixed-kernel", "pair_centre"},
                                                           {"auto", "pair_auto"},
                                                           {"legacy:linear50", "pair_legacy"}};
  const auto found = names.find(method);
  return found == names.end() ? std::nullopt : mean(found->second);
}

std::optional<double> InstructionCounts::per_shot(const std::string& method) const {
  static const std::map<std::string, std::string> names = {
      {"net", "shot_network"},
      {"fixed-moment", "shot_moment"},
      {"table", "shot_table"},
      {"legacy:linear50", "shot_legacy"},
      {"hemicube:32", "shot_hemicube_32"},
      {"hybrid:32", "shot_hemicube_32_near_network"},
      {"hemicube:64", "shot_hemicube_64"},
      {"hybrid:64", "shot_hemicube_64_near_network"}};
  const auto found = names.find(method);
  return found == names.end() ? std::nullopt : mean(found->second);
}

}  // namespace host
