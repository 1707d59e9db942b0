#include "legacy/legacy_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.hpp"

namespace host {

namespace {

using Json = nlohmann::ordered_json;
constexpr const char* kFormat = "urad-legacy 1";
constexpr const char* kPartial = "urad-legacy-training 1";

Json net_json(const LegacyNet& net) {
  return {{"hidden", net.hidden},
          {"scaling", name(net.scaling)},
          {"hidden_weight", net.hidden_weight},
          {"hidden_bias", net.hidden_bias},
          {"output_weight", net.output_weight},
          {"output_bias", net.output_bias}};
}

Json fixed_json(const LegacyTables& t) {
  return {{"hidden_weight", t.hidden_weight}, {"hidden_shift", t.hidden_shift},
          {"hidden_bias", t.hidden_bias},     {"output_weight", t.output_weight},
          {"output_shift", t.output_shift},   {"output_bias", t.output_bias}};
}

template <class Int>
std::vector<Int> integers(const Json& json) {
  std::vector<Int> values;
  for (const Json& item : json) {
    const auto value = item.get<std::int64_t>();
    if (!item.is_number_integer() || !std::in_range<Int>(value))
      throw Error(fmt::format("has {} where a smaller whole number belongs", item.dump()));
    values.push_back(Int(value));
  }
  return values;
}

LegacyTables tables_from(const Json& json, const LegacyNet& net) {
  LegacyTables t;
  t.hidden = net.hidden;
  t.scaling = net.scaling;
  t.hidden_weight = integers<std::int16_t>(json.at("hidden_weight"));
  t.hidden_shift = integers<std::uint8_t>(json.at("hidden_shift"));
  t.hidden_bias = integers<std::int32_t>(json.at("hidden_bias"));
  t.output_weight = integers<std::int16_t>(json.at("output_weight"));
  t.output_shift = integers<std::uint8_t>(Json::array({json.at("output_shift")}))[0];
  t.output_bias = integers<std::int32_t>(Json::array({json.at("output_bias")}))[0];
  (void)LegacyFixed(t);  // sizes and sums
  return t;
}

std::vector<float> floats(const Json& json, std::size_t count) {
  auto values = json.get<std::vector<float>>();
  bool good = values.size() == count;
  for (const float value : values) good = good && std::isfinite(value);
  if (!good) throw Error(fmt::format("needs lists of {} finite numbers", count));
  return values;
}

LegacyNet net_from(const Json& json) {
  LegacyNet net;
  net.hidden = json.at("hidden").get<int>();
  if (net.hidden < 1 || net.hidden > 256) throw Error("has a number of hidden units out of range");
  const auto hidden = std::size_t(net.hidden);
  const auto scaling = json.at("scaling").get<std::string>();
  if (scaling != "linear" && scaling != "log") throw Error("has a scaling that is not known");
  net.scaling = scaling == "log" ? LegacyScaling::log : LegacyScaling::linear;
  net.hidden_weight = floats(json.at("hidden_weight"), hidden * kLegacyInputs);
  net.hidden_bias = floats(json.at("hidden_bias"), hidden);
  net.output_weight = floats(json.at("output_weight"), hidden);
  net.output_bias = floats(Json::array({json.at("output_bias")}), 1)[0];
  return net;
}

}  // namespace

std::string to_json(const LegacyNetFile& file) {
  return Json{{"format", kFormat},
              {"command", file.command},
              {"subject", file.subject},
              {"seed", file.seed},
              {"epochs", file.epochs},
              {"best_epoch", file.best_epoch},
              {"training_error", file.training_error},
              {"validation_error", file.validation_error},
              {"test_error", file.test_error},
              {"net", net_json(file.net)},
              {"fixed", fixed_json(file.fixed)},
              {"rounding", {{"output", file.rounding.output}, {"factor", file.rounding.factor}}},
              {"errors",
               {{"std", file.errors.std},
                {"bias", file.errors.bias},
                {"p99", file.errors.p99},
                {"row_mean", file.errors.row_mean},
                {"row_worst", file.errors.row_worst}}}}
             .dump(1) +
         "\n";
}

bool is_legacy_json(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  return json.is_object() && json.contains("format") && json["format"].is_string() &&
         json["format"].get<std::string>().starts_with("urad-legacy ");
}

LegacyNetFile legacy_from_json(const std::string& text, const std::string& where) {
  try {
    const Json json = Json::parse(text);
    if (json.at("format") != kFormat)
      throw Error(fmt::format("is of another version than {}: train it again", kFormat));
    LegacyNetFile file;
    file.command = json.at("command").get<std::string>();
    file.subject = json.at("subject").get<std::string>();
    file.seed = json.at("seed").get<std::uint64_t>();
    file.epochs = json.at("epochs").get<int>();
    file.best_epoch = json.at("best_epoch").get<int>();
    file.training_error = json.at("training_error").get<double>();
    file.validation_error = json.at("validation_error").get<double>();
    file.test_error = json.at("test_error").get<double>();
    file.net = net_from(json.at("net"));
    file.fixed = tables_from(json.at("fixed"), file.net);
    const Json &rounding = json.at("rounding"), &errors = json.at("errors");
    file.rounding = {rounding.at("output").get<double>(), rounding.at("factor").get<double>()};
    file.errors = {errors.at("std").get<double>(), errors.at("bias").get<double>(),
                   errors.at("p99").get<double>(), errors.at("row_mean").get<double>(),
                   errors.at("row_worst").get<double>()};
    return file;
  } catch (const Error& error) {
    throw Error(fmt::format("{} {}", where, error.what()));
  } catch (const Json::exception& error) {
    throw Error(
        fmt::format("{} is no network of the report, or cut short: {}", where, error.what()));
  }
}

std::string to_json(const BackpropState& state, const std::string& command) {
  return Json{{"format", kPartial},
              {"command", command},
              {"epoch", state.epoch},
              {"net", net_json(state.net)},
              {"best", net_json(state.best)},
              {"best_error", state.best_error},
              {"best_epoch", state.best_epoch}}
             .dump() +
         "\n";
}

std::optional<BackpropState> backprop_from_json(const std::string& text,
                                                const std::string& command) {
  try {
    const Json json = Json::parse(text);
    if (json.at("format") != kPartial || json.at("command") != command) return {};
    BackpropState state;
    state.epoch = json.at("epoch").get<int>();
    state.net = net_from(json.at("net"));
    state.best = net_from(json.at("best"));
    state.best_error = json.at("best_error").get<double>();
    state.best_epoch = json.at("best_epoch").get<int>();
    return state;
  } catch (const Error&) {
    return {};
  } catch (const Json::exception&) {
    return {};
  }
}

}  // namespace host
