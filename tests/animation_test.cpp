// Animated PNGs, frame by frame, and the document of what skips save.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>

#include "base/csv.hpp"
#include "base/error.hpp"
#include "report/animation.hpp"
#include "report/apng.hpp"
#include "scene/builtin.hpp"
#include "skipping/skip_report.hpp"
#include "weights/general.h"

namespace {

const host::NetChoice kNets{[](const std::string&) -> const urad_net* { return &urad_general; }};

struct Chunk {
  std::string name, data;
};

std::uint32_t number_at(const std::string& text, std::size_t at) {
  std::uint32_t x = 0;
  for (std::size_t k = 0; k < 4; ++k) x = x << 8 | std::uint8_t(text.at(at + k));
  return x;
}

std::vector<Chunk> chunks(const std::string& file) {
  std::vector<Chunk> list;
  for (std::size_t at = 8; at < file.size();) {
    const std::size_t size = number_at(file, at);
    list.push_back({file.substr(at + 4, 4), file.substr(at + 8, size)});
    at += 12 + size;
  }
  return list;
}

host::Image grey(int size, std::uint8_t value) {
  return {size, size, 1, std::vector<std::uint8_t>(std::size_t(size * size), value)};
}

}  // namespace

TEST_CASE("an animated PNG holds every frame's own data, numbered without a gap") {
  const std::vector<host::Image> frames = {grey(5, 0), grey(5, 128), grey(5, 255)};
  const std::vector<Chunk> list = chunks(host::apng(frames, 40));
  std::vector<std::string> names;
  std::uint32_t sequence = 0;
  for (const Chunk& chunk : list) {
    names.push_back(chunk.name);
    if (chunk.name == "fcTL" || chunk.name == "fdAT") CHECK(number_at(chunk.data, 0) == sequence++);
  }
  CHECK(names == std::vector<std::string>{"IHDR", "acTL", "fcTL", "IDAT", "fcTL", "fdAT", "fcTL",
                                          "fdAT", "IEND"});
  CHECK(number_at(list[1].data, 0) == 3);
  const auto data = [&](std::size_t frame) {
    for (const Chunk& chunk : chunks(host::png(frames[frame])))
      if (chunk.name == "IDAT") return chunk.data;
    return std::string();
  };
  CHECK(list[3].data == data(0));
  CHECK(list[5].data.substr(4) == data(1));
  CHECK(list[7].data.substr(4) == data(2));
  CHECK_THROWS_AS(host::apng({}, 40), host::Error);
  CHECK_THROWS_AS(host::apng({grey(5, 0), grey(6, 0)}, 40), host::Error);
}

TEST_CASE("a painted wall settles frame by frame; a grey room has none to paint") {
  const host::Scene scene = host::load_scene("gallery", {3, 0});
  const host::FixedScene fixed(scene);
  const host::EngineRows rows = host::engine_rows(fixed, host::parse_method("net"), kNets, {}, 0);
  host::AnimationOptions options;
  options.paint_frames = 6;
  options.picture.width = options.picture.height = 16;
  const host::Animation wall = host::animate_wall(scene, rows, options);
  const host::CsvTable table = host::parse_csv(wall.table, "wall");
  REQUIRE(table.rows.size() == 7);
  CHECK(wall.frames.size() == 7);
  const std::size_t error = table.column("error");
  const auto error_of = [&](std::size_t frame) {
    return std::stod(table.rows[frame].cells[error]);
  };
  CHECK(error_of(1) > error_of(0));
  CHECK(error_of(6) < error_of(1));
  host::Scene none = scene;
  for (host::Material& material : none.materials) material.reflectance = host::Vec3(0.5);
  CHECK_THROWS_AS(host::animate_wall(none, rows, options), host::Error);
}

TEST_CASE("an object goes its way step by step, and the light follows; walls alone stay") {
  host::AnimationOptions options;
  options.steps = 2, options.frames = 3;
  options.picture.width = options.picture.height = 16;
  const host::Scene scene = host::load_scene("louvre", {3, 0});
  const host::Animation moved = host::animate_object(scene, kNets, options);
  const host::CsvTable table = host::parse_csv(moved.table, "object");
  REQUIRE(table.rows.size() == 7);
  CHECK(moved.frames.size() == 7);
  const auto cell = [&](std::size_t frame, const char* column) {
    return std::stod(table.rows[frame].cells[table.column(column)]);
  };
  CHECK(cell(3, "error") < 0.01);
  CHECK(cell(6, "error") < 0.01);
  CHECK(cell(6, "shots") == 120);
  CHECK(cell(6, "pairs") > cell(3, "pairs"));
  CHECK(host::animate_object(host::load_scene("gallery", {2, 0}), kNets, options).frames.empty());
}

TEST_CASE("the document of skips: a column a scene, early answers within a third of the work") {
  const host::SkipReport report = host::skip_report("gallery", kNets, "", 0);
  CHECK(report.by_pairs.rays == 0);
  CHECK(report.error_worth < 0.01);
  const host::EarlyAnswer& best = report.early.back();
  CHECK(best.shots[0] > 0);
  CHECK(3 * best.shots[0] < best.shots[3]);
  const std::string text = host::skip_document({report}, "urad skipping", "x.svg");
  CHECK(text.find("| convex: no thought of blockers | 42,408 |") != std::string::npos);
  CHECK(host::skip_chart({report}).find("gallery") != std::string::npos);
  CHECK_THROWS_AS(host::skip_report("gallery", kNets, "no such file", 0), host::Error);
}
