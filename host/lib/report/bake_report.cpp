#include "report/bake_report.hpp"

#include <nlohmann/json.hpp>

#include "report/counters_json.hpp"

namespace host {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
void put(Json* json, const char* key, const std::optional<Value>& value) {
  if (value) (*json)[key] = *value;
}

Json facts_json(const std::vector<Fact>& facts) {
  Json json = Json::object();
  for (const Fact& fact : facts) json[fact.name] = fact.value;
  return json;
}

Json method_json(const MethodResult& method) {
  Json json{{"name", method.name}, {"title", method.label()}, {"reference", method.reference}};
  put(&json, "b_rms", method.errors.b_rms);
  put(&json, "b_max", method.errors.b_max);
  put(&json, "f_std", method.errors.f_std);
  put(&json, "f_max", method.errors.f_max);
  put(&json, "row_mean", method.errors.row_mean);
  put(&json, "row_worst", method.errors.row_worst);
  put(&json, "shots", method.shots);
  put(&json, "seconds", method.seconds);
  put(&json, "ns_per_pair", method.ns_per_pair);
  put(&json, "m0_instructions_per_pair", method.m0_instructions_per_pair);
  put(&json, "m0_instructions", method.m0_instructions);
  put(&json, "ram_bytes", method.ram_bytes);
  put(&json, "flash_bytes", method.flash_bytes);
  if (!method.memory.empty()) json["memory"] = facts_json(method.memory);
  if (method.counters) json["counters"] = counters_json(*method.counters);
  if (method.audit) {
    const EnergyAudit& audit = *method.audit;
    json["energy"] = {{"emitted", audit.emitted},
                      {"absorbed", audit.absorbed},
                      {"unshot", audit.unshot},
                      {"escaped", audit.escaped},
                      {"exact", audit.exact()}};
  }
  if (!method.pictures.difference.empty())
    json["difference_scale"] = method.pictures.difference_scale;
  return json;
}

}  // namespace

void add_pictures(const Scene& scene, const PictureOptions& options, BakeReport* report) {
  const MethodResult* exact = report->reference();
  if (report->methods.empty()) return;
  const View view(scene, options);
  const double white = white_level(scene, exact ? exact->B : report->methods.front().B);
  for (MethodResult& method : report->methods) {
    if (method.B.empty()) continue;
    MethodPictures& pictures = method.pictures;
    pictures.smooth = png(view.picture(method.B, Shading::kSmooth, white));
    pictures.flat = png(view.picture(method.B, Shading::kFlat, white));
    if (!exact || method.reference) continue;
    const double scale = view.difference_scale(method.B, exact->B, Shading::kSmooth, white);
    const auto difference = [&](Channel channel) {
      return png(view.difference(method.B, exact->B, Shading::kSmooth, scale, channel));
    };
    pictures.difference_scale = scale / white;
    pictures.difference = difference(Channel::kAll);
    pictures.channel_difference = {difference(Channel::kRed), difference(Channel::kGreen),
                                   difference(Channel::kBlue)};
  }
}

std::string report_json(const std::vector<BakeReport>& reports) {
  Json scenes = Json::array();
  for (const BakeReport& report : reports) {
    Json json{{"title", report.title},
              {"scene", report.scene},
              {"version", report.version},
              {"command", report.command},
              {"facts", facts_json(report.facts)},
              {"network", facts_json(report.network)},
              {"files", facts_json(report.files)},
              {"reproduce", report.reproduce},
              {"methods", Json::array()}};
    for (const MethodResult& method : report.methods)
      json["methods"].push_back(method_json(method));
    scenes.push_back(std::move(json));
  }
  const Json& whole = scenes.size() == 1 ? scenes[0] : Json{{"scenes", scenes}};
  // Names come from files: bytes that are not UTF-8 become replacement characters rather than an
  // exception.
  return whole.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace host
