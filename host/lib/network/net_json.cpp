#include "network/net_json.hpp"

#include <fmt/core.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "urad/pair.hpp"

namespace host {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;

std::vector<double> part(const Eigen::VectorXd& v, int first, int count) {
  return {v.data() + first, v.data() + first + count};
}

Json rescale_json(const urad_rescale& r) { return Json::array({r.multiplier, r.shift}); }

Json float_json(const FloatNet& net) {
  const auto& p = net.parameters;
  return {{"inputs", net.inputs()},
          {"hidden", net.hidden()},
          {"hidden_weight", part(p, 0, net.hidden_bias_at())},
          {"hidden_bias", part(p, net.hidden_bias_at(), net.hidden())},
          {"output_weight", part(p, net.output_at(), net.hidden())},
          {"skip_weight", part(p, net.skip_at(), net.inputs())},
          {"output_bias", net.output_bias()}};
}

Json quantised_json(const QuantisedNet& net) {
  const NetTables& t = net.tables();
  Json rescales = Json::array();
  for (const urad_rescale& r : t.hidden_rescale) rescales.push_back(rescale_json(r));
  return {{"weight_bits", t.weight_bits},     {"far_rho_uq16", t.far_rho_uq16},
          {"near_rho_uq16", t.near_rho_uq16}, {"hidden_weight", t.hidden_weight},
          {"hidden_bias", t.hidden_bias},     {"hidden_rescale", rescales},
          {"output_weight", t.output_weight}, {"skip_weight", t.skip_weight},
          {"output_bias", t.output_bias},     {"output_rescale", rescale_json(t.output_rescale)},
          {"crc32", net.pod().crc32}};
}

Json error_json(const ErrorRow& row) {
  Json json{{"name", row.name}, {"pairs", row.pairs}, {"median", row.median}, {"p95", row.p95},
            {"p99", row.p99},   {"max", row.max},     {"std", row.std},       {"bias", row.bias}};
  if (row.rows) json["row_mean"] = row.rows->mean, json["row_worst"] = row.rows->worst;
  return json;
}

// One object of the file, with the words for what is wrong with it.
class Reader {
 public:
  Reader(const Json& json, std::string where) : json_(json), where_(std::move(where)) {
    if (!json_.is_object()) fail("is not an object");
  }

  [[noreturn]] void fail(const std::string& what) const { throw Error(where_ + " " + what); }

  const Json& at(const char* key) const {
    const auto found = json_.find(key);
    if (found == json_.end()) fail(fmt::format("has no \"{}\": train or export it again", key));
    return *found;
  }
  bool has(const char* key) const { return json_.contains(key); }
  Reader object(const char* key) const { return {at(key), where_ + " \"" + key + "\""}; }

  std::string text(const char* key) const {
    const Json& value = at(key);
    if (!value.is_string()) fail(fmt::format("has a \"{}\" that is not text", key));
    return value.get<std::string>();
  }
  double number(const char* key) const { return number(at(key), key); }

  template <class Int>
  Int integer(const char* key) const {
    return integer<Int>(at(key), key);
  }
  template <class Int>
  std::vector<Int> integers(const char* key, std::size_t count) const {
    std::vector<Int> result;
    for (const Json& value : array(key, count)) result.push_back(integer<Int>(value, key));
    return result;
  }
  std::vector<double> numbers(const char* key, std::size_t count) const {
    std::vector<double> result;
    for (const Json& value : array(key, count)) result.push_back(number(value, key));
    return result;
  }
  urad_rescale rescale(const Json& pair, const char* key) const {
    if (!pair.is_array() || pair.size() != 2)
      fail(fmt::format("has a \"{}\" that is not [multiplier, shift]", key));
    return {integer<std::uint16_t>(pair[0], key), integer<std::uint16_t>(pair[1], key)};
  }
  const Json& array(const char* key, std::size_t count) const {
    const Json& values = at(key);
    if (!values.is_array() || values.size() != count)
      fail(fmt::format("needs {} numbers in \"{}\", not {}", count, key, values.size()));
    return values;
  }

 private:
  double number(const Json& value, const char* key) const {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      fail(fmt::format("has {} in \"{}\" where a finite number belongs", value.dump(), key));
    return value.get<double>();
  }
  template <class Int>
  Int integer(const Json& value, const char* key) const {
    const bool fits =
        value.is_number_unsigned()
            ? std::in_range<Int>(value.get<std::uint64_t>())
            : value.is_number_integer() && std::in_range<Int>(value.get<std::int64_t>());
    if (!fits)
      fail(
          fmt::format("has {} in \"{}\" where a whole number in range belongs", value.dump(), key));
    return value.get<Int>();
  }

  const Json& json_;
  std::string where_;
};

int count_in(const Reader& reader, const char* key, int most) {
  const int value = reader.integer<int>(key);
  if (value < 1 || value > most)
    reader.fail(fmt::format("has {} {}, not 1 to {}", value, key, most));
  return value;
}

FloatNet read_float(const Reader& reader) {
  const int inputs = count_in(reader, "inputs", URAD_NET_MAX_INPUTS);
  const int hidden = count_in(reader, "hidden", URAD_NET_MAX_HIDDEN);
  if (inputs != urad::kPairInputs)
    reader.fail(fmt::format("has {} inputs; a pair of patches has {}", inputs, urad::kPairInputs));
  FloatNet net(inputs, hidden);
  const auto put = [&](const char* key, int first, int count) {
    const std::vector<double> values = reader.numbers(key, std::size_t(count));
    std::copy(values.begin(), values.end(), net.parameters.data() + first);
  };
  put("hidden_weight", 0, hidden * inputs);
  put("hidden_bias", net.hidden_bias_at(), hidden);
  put("output_weight", net.output_at(), hidden);
  put("skip_weight", net.skip_at(), inputs);
  net.parameters[net.bias_at()] = reader.number("output_bias");
  return net;
}

QuantisedNet read_quantised(const Reader& reader, const FloatNet& net, int bits) {
  NetTables t;
  const auto inputs = std::size_t(net.inputs()), hidden = std::size_t(net.hidden());
  t.inputs = net.inputs(), t.hidden = net.hidden();
  t.weight_bits = reader.integer<int>("weight_bits");
  if (t.weight_bits != bits)
    reader.fail(fmt::format("has weights of {} bits, not {}", t.weight_bits, bits));
  t.far_rho_uq16 = reader.integer<std::uint16_t>("far_rho_uq16");
  t.near_rho_uq16 = reader.integer<std::uint16_t>("near_rho_uq16");
  t.hidden_weight = reader.integers<std::int16_t>("hidden_weight", inputs * hidden);
  t.hidden_bias = reader.integers<std::int32_t>("hidden_bias", hidden);
  for (const Json& pair : reader.array("hidden_rescale", hidden))
    t.hidden_rescale.push_back(reader.rescale(pair, "hidden_rescale"));
  t.output_weight = reader.integers<std::int16_t>("output_weight", hidden);
  t.skip_weight = reader.integers<std::int16_t>("skip_weight", inputs);
  t.output_bias = reader.integer<std::int32_t>("output_bias");
  t.output_rescale = reader.rescale(reader.at("output_rescale"), "output_rescale");
  try {
    QuantisedNet quantised(t);
    if (quantised.pod().crc32 != reader.integer<std::uint32_t>("crc32"))
      reader.fail("has been changed: its numbers do not give its \"crc32\"");
    return quantised;
  } catch (const Error& error) {
    const std::string what = error.what();
    if (what.rfind("not a network", 0) != 0) throw;
    reader.fail("is " + what);
  }
}

ErrorRow read_error(const Reader& reader) {
  ErrorRow row;
  row.name = reader.text("name");
  row.pairs = reader.integer<std::size_t>("pairs");
  row.median = reader.number("median"), row.p95 = reader.number("p95");
  row.p99 = reader.number("p99"), row.max = reader.number("max");
  row.std = reader.number("std"), row.bias = reader.number("bias");
  if (reader.has("row_mean"))
    row.rows = RowSums{reader.number("row_mean"), reader.number("row_worst")};
  return row;
}

}  // namespace

const ErrorRow* NetFile::error(const std::string& name) const {
  for (const ErrorRow& row : errors)
    if (row.name == name) return &row;
  return nullptr;
}

const QuantisedNet& NetFile::quantised(int bits) const {
  if (bits != 8 && bits != 16) throw Error(fmt::format("weights have 8 or 16 bits, not {}", bits));
  return bits == 8 ? quantised8 : quantised16;
}

std::string to_json(const NetFile& file) {
  Json errors = Json::array();
  for (const ErrorRow& row : file.errors) errors.push_back(error_json(row));
  const Json json{{"format", "urad-net"},
                  {"version", kVersion},
                  {"command", file.command},
                  {"subject", file.subject},
                  {"split", file.split},
                  {"seed", file.seed},
                  {"far_rho", file.far_rho},
                  {"errors", errors},
                  {"float", float_json(file.net)},
                  {"int16", quantised_json(file.quantised16)},
                  {"int8", quantised_json(file.quantised8)}};
  return json.dump(1) + "\n";
}

NetFile net_from_json(const std::string& text, const std::string& where) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw Error(fmt::format(
        "{}: not JSON from byte {} of {} on: cut short, damaged, or not written by urad train",
        where, error.byte, text.size()));
  } catch (const Json::out_of_range&) {
    throw Error(fmt::format("{}: holds a number too large to be read: damaged", where));
  }
  const Reader reader(json, where + ":");
  if (reader.text("format") != "urad-net")
    reader.fail("is no network: \"format\" should be \"urad-net\"");
  if (const int version = reader.integer<int>("version"); version != kVersion)
    reader.fail(
        fmt::format("has version {}, this program reads {}: train it again", version, kVersion));
  const FloatNet net = read_float(reader.object("float"));
  NetFile file{reader.text("command"),
               reader.text("subject"),
               reader.text("split"),
               reader.integer<std::uint64_t>("seed"),
               reader.number("far_rho"),
               net,
               read_quantised(reader.object("int16"), net, 16),
               read_quantised(reader.object("int8"), net, 8),
               {}};
  const Json& errors = reader.at("errors");
  if (!errors.is_array()) reader.fail("has \"errors\" that are not a list");
  for (const Json& row : errors) file.errors.push_back(read_error({row, where + ": \"errors\""}));
  return file;
}

NetFile read_net(const std::string& path) { return net_from_json(read_file(path), path); }

}  // namespace host
