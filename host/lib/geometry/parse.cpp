#include "geometry/parse.hpp"

#include <charconv>
#include <cstdlib>
#include <system_error>

namespace host {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

/// Cuts the text before the first `mark` off; false when there is no text left to cut.
bool take_until(char mark, std::string_view* rest, std::string_view* part, bool* done) {
  if (*done) return false;
  const std::size_t at = rest->find(mark);
  *part = rest->substr(0, at);
  *done = at == std::string_view::npos;
  if (!*done) rest->remove_prefix(at + 1);
  return true;
}

bool read_number(std::string_view token, double* value) {
  if (token.size() > 1 && token[0] == '+' && token[1] != '-') token.remove_prefix(1);
  const char* end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, *value);
  if (stop != end || error == std::errc::invalid_argument) return false;
  // Out of range says not which way: strtod gives the infinity or the rounded-off zero.
  if (error == std::errc::result_out_of_range)
    *value = std::strtod(std::string(token).c_str(), nullptr);
  return true;
}

bool read_vertex(std::string_view text, Vec3* vertex) {
  int count = 0;
  for (;;) {
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return count == 3;
    text.remove_prefix(first);
    const std::string_view token = text.substr(0, text.find_first_of(kBlanks));
    if (count == 3 || !read_number(token, &(*vertex)[count])) return false;
    text.remove_prefix(token.size());
    ++count;
  }
}

bool read_loop(std::string_view text, Loop* loop) {
  std::string_view part;
  bool done = false;
  while (take_until(';', &text, &part, &done)) {
    Vec3 vertex;
    if (!read_vertex(part, &vertex)) return false;
    loop->push_back(vertex);
  }
  return true;
}

}  // namespace

bool read_polygon(std::string_view text, Polygon* polygon) {
  *polygon = {};
  std::string_view part;
  bool done = false;
  bool outer = true;
  while (take_until('|', &text, &part, &done)) {
    Loop loop;
    if (!read_loop(part, &loop)) return false;
    if (outer) {
      polygon->outer = std::move(loop);
    } else {
      polygon->holes.push_back(std::move(loop));
    }
    outer = false;
  }
  return true;
}

ParsedPolygon parse_polygon(std::string_view text) {
  ParsedPolygon result;
  result.status = read_polygon(text, &result.polygon) ? validate(result.polygon)
                                                      : PolygonStatus::invalid_syntax;
  return result;
}

std::string write_polygon(const Polygon& polygon) {
  std::string text;
  const auto add_loop = [&](const Loop& loop) {
    for (std::size_t k = 0; k < loop.size(); ++k)
      for (int c = 0; c < 3; ++c) {
        char digits[32];
        const auto end = std::to_chars(digits, digits + sizeof digits, loop[k][c]);
        text += c > 0 ? " " : k > 0 ? ";" : "";
        text.append(digits, end.ptr);
      }
  };
  add_loop(polygon.outer);
  for (const Loop& hole : polygon.holes) {
    text += '|';
    add_loop(hole);
  }
  return text;
}

}  // namespace host
