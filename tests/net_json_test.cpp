// net.json: what is written is read, and what is damaged is named.
#include "network/net_json.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "network_file.hpp"

namespace {

using Json = nlohmann::ordered_json;

// The message for the file after `change`, or "" when it was taken.
template <class Change>
std::string complaint(Change change) {
  Json json = Json::parse(host::to_json(test::network_file(7)));
  change(json);
  try {
    host::net_from_json(json.dump(), "some/net.json");
  } catch (const host::Error& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& message, const char* part) {
  INFO(message);
  const bool found = message.find(part) != std::string::npos && message.find("some/net.json") == 0;
  CHECK(found);
  return found;
}

}  // namespace

TEST_CASE("a net survives its file to the last bit") {
  const host::NetFile file = test::network_file(7);
  const std::string text = host::to_json(file);
  const host::NetFile read = host::net_from_json(text, "net.json");
  CHECK(read.net.parameters == file.net.parameters);
  CHECK(read.quantised16.pod().crc32 == file.quantised16.pod().crc32);
  CHECK(read.quantised8.pod().crc32 == file.quantised8.pod().crc32);
  CHECK(read.command == file.command);
  CHECK(read.errors.size() == file.errors.size());
  CHECK(host::to_json(read) == text);
}

TEST_CASE("a file cut short anywhere is refused with its name") {
  const std::string text = host::to_json(test::network_file(7));
  for (std::size_t length = 0; length + 2 < text.size(); length += 97) {
    try {
      host::net_from_json(text.substr(0, length), "some/net.json");
      FAIL_CHECK("taken after " << length << " bytes");
    } catch (const host::Error& error) {
      CHECK(std::string(error.what()).find("some/net.json: not JSON") == 0);
    }
  }
}

TEST_CASE("what is wrong in a file is named") {
  CHECK(complaint([](Json&) {}).empty());
  says(complaint([](Json& j) { j["version"] = 2; }), "version 2");
  says(complaint([](Json& j) { j["format"] = "bread"; }), "format");
  says(complaint([](Json& j) { j.erase("int8"); }), "no \"int8\"");
  says(complaint([](Json& j) { j["float"]["hidden"] = 65; }), "65 hidden");
  says(complaint([](Json& j) { j["float"]["hidden_bias"].erase(0); }), "hidden_bias");
  says(complaint([](Json& j) { j["float"]["skip_weight"][3] = "x"; }), "skip_weight");
  says(complaint([](Json& j) { j["float"]["output_bias"] = nullptr; }), "output_bias");
  says(complaint([](Json& j) { j["int16"]["hidden_weight"][0] = 40000; }), "40000");
  says(complaint([](Json& j) { j["int16"]["hidden_weight"][0] = 1.5; }), "1.5");
  says(complaint([](Json& j) { j["int16"]["hidden_rescale"][0] = 5; }), "hidden_rescale");
  says(complaint([](Json& j) { j["int16"]["output_rescale"][1] = 60; }), "shift");
  says(complaint([](Json& j) { j["int8"]["crc32"] = 1; }), "crc32");
  says(complaint([](Json& j) { j["errors"] = 1; }), "errors");
  says(complaint([](Json& j) { j = 5; }), "not an object");
}
