#include "scene/obj_lines.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <set>

#include "base/error.hpp"

namespace host {
namespace {

constexpr std::string_view kBlank = " \t\r";

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(kBlank); at != line.npos;
       at = line.find_first_not_of(kBlank, at)) {
    const std::size_t end = std::min(line.find_first_of(kBlank, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

// All after the first word, without blanks at the ends: names may hold blanks.
std::string rest_of(std::string_view line, std::string_view first) {
  const auto from = std::size_t(first.data() - line.data()) + first.size();
  const std::size_t start = line.find_first_not_of(kBlank, from);
  if (start == line.npos) return {};
  return std::string(line.substr(start, line.find_last_not_of(kBlank) - start + 1));
}

std::optional<double> finite_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (status != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

template <class Fn>
void each_line(std::string_view text, const Fn& fn) {
  std::size_t number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    fn(++number, text.substr(at, end - at));
    at = end + 1;
  }
}

[[noreturn]] void fail(const std::string& file, std::size_t line, const std::string& what) {
  throw Error(fmt::format("{}:{}: {}", file, line, what));
}

/// A corner of a face: whole numbers, not 0, with slashes between; tinyobjloader would let others
/// wrap or lose a part.
void check_corner(std::string_view corner, const std::string& file, std::size_t line) {
  bool good = true;
  for (std::size_t at = 0; good && at <= corner.size();) {
    const std::size_t slash = std::min(corner.find('/', at), corner.size());
    const std::string_view number = corner.substr(at, slash - at);
    std::int32_t value = 0;
    const auto [end, status] = std::from_chars(number.data(), number.data() + number.size(), value);
    const bool read = status == std::errc() && end == number.data() + number.size() && value != 0;
    good = read || (number.empty() && at > 0);
    at = slash + 1;
  }
  if (!good)
    fail(file, line,
         fmt::format("a face corner is '{}'; it should be a vertex number such as 7, 7/1 or 7//2",
                     corner));
}

Vec3 three_numbers(const std::vector<std::string_view>& words, const std::string& file,
                   std::size_t line, std::string_view what) {
  if (words.size() < 4)
    fail(file, line, fmt::format("{} takes three numbers, not {}", what, words.size() - 1));
  Vec3 x(0);
  for (int k = 0; k < 3; ++k) {
    const std::string_view word = words[std::size_t(k) + 1];
    const auto value = finite_number(word);
    if (!value) fail(file, line, fmt::format("{}: '{}' is not a finite number", what, word));
    x[k] = *value;
  }
  return x;
}

// words: "#", "camera", "eye", x, y, z, ...
Camera read_camera(const std::vector<std::string_view>& words, const std::string& file,
                   std::size_t line) {
  Camera camera;
  std::size_t at = 2;
  const auto number = [&] {
    const auto value = at < words.size() ? finite_number(words[at]) : std::nullopt;
    if (!value)
      fail(file, line,
           "the camera is '# camera eye x y z target x y z up x y z fov degrees [mirrored]'");
    ++at;
    return *value;
  };
  const auto vector = [&] {
    const double x = number(), y = number(), z = number();
    return Vec3(x, y, z);
  };
  while (at < words.size()) {
    const std::string_view key = words[at++];
    if (key == "eye")
      camera.eye = vector();
    else if (key == "target")
      camera.target = vector();
    else if (key == "up")
      camera.up = vector();
    else if (key == "fov")
      camera.field_of_view = number();
    else if (key == "mirrored")
      camera.mirrored = true;
    else
      fail(file, line,
           fmt::format("the camera has eye, target, up, fov and mirrored, but not '{}'", key));
  }
  if (camera.eye == camera.target)
    fail(file, line, "the camera's eye and target are the same point");
  if (glm::length(glm::cross(camera.target - camera.eye, camera.up)) == 0)
    fail(file, line, "the camera looks along its up direction");
  if (!(camera.field_of_view > 0 && camera.field_of_view < 180))
    fail(file, line,
         fmt::format("the camera's fov must lie between 0 and 180 degrees, not {}",
                     camera.field_of_view));
  return camera;
}

// words: "#", "grid", then one or two counts; prose after "# grid" is prose.
std::optional<std::array<int, 2>> read_counts(const std::vector<std::string_view>& words,
                                              const std::string& file, std::size_t line) {
  if (words.size() < 3 || words.size() > 4) return std::nullopt;
  std::array<int, 2> counts{};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto value = finite_number(words[std::min(2 + k, words.size() - 1)]);
    if (!value) return std::nullopt;
    if (*value < 1 || *value > 255 || *value != std::floor(*value))
      fail(file, line, fmt::format("a grid takes counts from 1 to 255, not {}", *value));
    counts[k] = int(*value);
  }
  return counts;
}

/// Without a comment at its end; a line that is a comment stays, urad reads some of them.
std::string_view without_comment(std::string_view line) {
  const std::size_t first = line.find_first_not_of(kBlank);
  for (std::size_t at = line.find('#'); at != line.npos; at = line.find('#', at + 1))
    if (at > 0 && at != first && kBlank.find(line[at - 1]) != kBlank.npos)
      return line.substr(0, at);
  return line;
}

}  // namespace

std::string plain_lines(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  std::string plain;
  plain.reserve(text.size() + 1);
  std::size_t joined = 0;  // lines that the one in work has taken in
  each_line(text, [&](std::size_t, std::string_view line) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    const std::size_t first = line.find_first_not_of(kBlank);
    const bool comment = joined == 0 && first != line.npos && line[first] == '#';
    line = without_comment(line);
    if (!comment && line.ends_with('\\')) {
      plain.append(line.substr(0, line.size() - 1)) += ' ';
      ++joined;
      return;
    }
    plain.append(line).append(joined + 1, '\n');
    joined = 0;
  });
  return plain.append(joined, '\n');
}

ObjLines index_obj(std::string_view text, const std::string& file) {
  ObjLines found;
  std::set<std::string> used;
  std::string material;
  std::size_t material_line = 0;
  std::array<int, 2> counts{1, 1};
  each_line(text, [&](std::size_t line, std::string_view content) {
    const auto words = words_of(content);
    if (words.empty()) return;
    if (words[0] == "v") {
      found.vertices.push_back(three_numbers(words, file, line, "a vertex"));
    } else if (words[0] == "f") {
      if (words.size() < 4) fail(file, line, "a face needs at least 3 vertices");
      if (material.empty())
        fail(file, line, "a face without material: put 'usemtl NAME' before it");
      for (std::size_t k = 1; k < words.size(); ++k) check_corner(words[k], file, line);
      found.faces.push_back({line, material, counts});
      if (used.insert(material).second) found.material_uses.emplace_back(material, material_line);
    } else if (words[0] == "usemtl") {
      material = rest_of(content, words[0]);
      if (material.empty()) fail(file, line, "usemtl without a name");
      material_line = line;
    } else if (words[0] == "mtllib") {
      const std::string library = rest_of(content, words[0]);
      if (library.empty()) fail(file, line, "mtllib without a file name");
      found.libraries.emplace_back(library, line);
    } else if (words[0] == "#" && words.size() > 2) {
      if (words[1] == "camera" && words[2] == "eye") found.camera = read_camera(words, file, line);
      if (words[1] == "grid") counts = read_counts(words, file, line).value_or(counts);
    }
  });
  if (found.vertices.empty()) fail(file, 1, "no vertex in the whole file: is it an OBJ?");
  if (found.faces.empty())
    fail(file, 1, "no face in the whole file; a scene needs at least two patches");
  return found;
}

std::map<std::string, MtlLines> index_mtl(std::string_view text, const std::string& file) {
  std::map<std::string, MtlLines> found;
  MtlLines* current = nullptr;
  each_line(text, [&](std::size_t line, std::string_view content) {
    const auto words = words_of(content);
    if (words.empty()) return;
    if (words[0] == "newmtl") {
      const std::string name = rest_of(content, words[0]);
      if (name.empty()) fail(file, line, "newmtl without a name");
      const auto [at, fresh] = found.emplace(name, MtlLines{line, 0, 0, Vec3(0), Vec3(0)});
      if (!fresh)
        fail(file, line,
             fmt::format("material '{}' stands in line {} already", name, at->second.line));
      current = &at->second;
    } else if (words[0] == "Kd" || words[0] == "Ke") {
      if (!current) fail(file, line, fmt::format("{} before the first newmtl", words[0]));
      const bool kd = words[0] == "Kd";
      (kd ? current->kd : current->ke) = three_numbers(words, file, line, words[0]);
      (kd ? current->kd_line : current->ke_line) = line;
    }
  });
  return found;
}

}  // namespace host
