#include "network/checkpoint.hpp"

#include <nlohmann/json.hpp>

namespace host {

namespace {
using Json = nlohmann::ordered_json;
constexpr const char* kFormat = "urad-training 1";
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
  return Json{{"format", kFormat},
              {"command", checkpoint.command},
              {"finished", checkpoint.finished},
              {"stage", state.stage},
              {"place", state.place},
              {"iteration", state.iteration},
              {"candidates", candidates}}
             .dump() +
         "\n";
}

std::optional<Checkpoint> checkpoint_from_json(const std::string& text,
                                               const std::string& command) {
  try {
    const Json json = Json::parse(text);
    if (json.at("format") != kFormat || json.at("command") != command) return std::nullopt;
    Checkpoint checkpoint;
    checkpoint.command = command;
    checkpoint.finished = json.at("finished").get<std::vector<std::vector<double>>>();
    TrainerState& state = checkpoint.state;
    state.stage = json.at("stage"), state.place = json.at("place");
    state.iteration = json.at("iteration");
    for (const Json& c : json.at("candidates"))
      state.candidates.push_back({c.at("id"), c.at("parameters").get<std::vector<double>>(),
                                  c.at("best").get<std::vector<double>>(), c.at("best_value"),
                                  c.at("damping"), c.at("growth"), c.at("finished")});
    return checkpoint;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace host
