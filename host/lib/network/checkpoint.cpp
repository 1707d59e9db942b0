#include "network/checkpoint.hpp"

#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "network/digest.hpp"

namespace host {

namespace {
using Json = nlohmann::ordered_json;
constexpr const char* kFormat = "urad-training 2";

/// Of all else that the file says: an altered number would end in another net, and nobody would
/// know.
std::string digest_of(Json json) {
  json.erase("sha256");
  return sha256(json.dump());
}

Checkpoint read(const Json& json) {
  Checkpoint checkpoint;
  checkpoint.command = json.at("command");
  checkpoint.finished = json.at("finished").get<std::vector<std::vector<double>>>();
  TrainerState& state = checkpoint.state;
  state.stage = json.at("stage"), state.place = json.at("place");
  state.iteration = json.at("iteration");
  for (const Json& c : json.at("candidates"))
    state.candidates.push_back({c.at("id"), c.at("parameters").get<std::vector<double>>(),
                                c.at("best").get<std::vector<double>>(), c.at("best_value"),
                                c.at("damping"), c.at("growth"), c.at("finished")});
  return checkpoint;
}
}  // namespace

std::string to_json(const Checkpoint& checkpoint) {
  const TrainerState& state = checkpoint.state;
  Json candidates = Json::array();
  for (const Candidate& c : state.candidates)
    candidates.push_back({{"id", c.id},
                          {"parameters", c.parameters},
                          {"best", c.best},
                          {"best_value", c.best_value},
                          {"damping", c.damping},
                          {"growth", c.growth},
                          {"finished", c.finished}});
  Json json{
      {"format", kFormat},       {"command", checkpoint.command}, {"finished", checkpoint.finished},
      {"stage", state.stage},    {"place", state.place},          {"iteration", state.iteration},
      {"candidates", candidates}};
  json["sha256"] = digest_of(json);
  return json.dump() + "\n";
}

std::optional<Checkpoint> checkpoint_from_json(const std::string& text, const std::string& command,
                                               const std::string& where) {
  const Json json = Json::parse(text, nullptr, false);
  const auto says = [&](const char* key, const std::string& value) {
    return json.contains(key) && json[key] == value;
  };
  if (!json.is_object() || !says("format", kFormat) || !says("command", command))
    return std::nullopt;
  try {
    if (says("sha256", digest_of(json))) return read(json);
  } catch (const Json::exception&) {  // the sentence below is the better one
  }
  throw Error(where + ": this training state has been altered; delete it to train from the start");
}

}  // namespace host
