#include "stress/mutate.hpp"

#include <algorithm>

namespace host {
namespace {

constexpr const char* kNumbers[] = {
    "0",     "-0",   "1",          "-1",          "0.5",        "2",    "1e308",
    "1e999", "-1e9", "1e-320",     "nan",         "-inf",       "1e",   ".",
    "255",   "256",  "65535",      "65536",       "2147483647", "1e30", "-2147483648",
    "1,5",   "0x10", "4294967297", "00000000001", "1e-12",      "+-1",  "18446744073709551616",
};

std::size_t place(const std::string& text, Random& random) {
  return std::size_t(random.uniform() * double(text.size() + 1));
}

/// Start and length of a line around a random place, its end included.
std::pair<std::size_t, std::size_t> line(const std::string& text, Random& random) {
  const std::size_t at = std::min(place(text, random), text.size());
  const std::size_t before = at == 0 ? text.npos : text.rfind('\n', at - 1);
  const std::size_t first = before == text.npos ? 0 : before + 1;
  const std::size_t end = text.find('\n', at);
  return {first, (end == text.npos ? text.size() : end + 1) - first};
}

bool of_number(char c) {
  return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e';
}

void replace_number(std::string* text, Random& random) {
  std::size_t first = place(*text, random);
  while (first < text->size() && !of_number((*text)[first])) ++first;
  std::size_t end = first;
  while (end < text->size() && of_number((*text)[end])) ++end;
  text->replace(first, end - first, kNumbers[random.below(int(std::size(kNumbers)))]);
}

void change(std::string* text, const std::string& other, const std::vector<std::string>& words,
            Random& random) {
  const std::size_t at = place(*text, random);
  const auto length = std::size_t(random.log_uniform(1, 64));
  switch (random.below(10)) {
    case 0:
      if (at < text->size()) (*text)[at] = char((*text)[at] ^ (1 << random.below(8)));
      break;
    case 1:
      text->erase(at, length);
      break;
    case 2:
      text->insert(at, 1, char(random.below(256)));
      break;
    case 3:
      text->insert(at, text->substr(place(*text, random), length));
      break;
    case 4:
      replace_number(text, random);
      break;
    case 5:
      if (!words.empty()) text->insert(at, words[std::size_t(random.below(int(words.size())))]);
      break;
    case 6: {
      const auto [first, size] = line(*text, random);
      text->erase(first, size);
      break;
    }
    case 7: {
      const auto [first, size] = line(*text, random);
      text->insert(line(*text, random).first, text->substr(first, size));
      break;
    }
    case 8: {
      const auto [first, size] = line(other, random);
      text->insert(line(*text, random).first, other.substr(first, size));
      break;
    }
    default:
      if (random.below(4) == 0) text->resize(at);
  }
}

}  // namespace

std::string mutated(const std::string& text, const std::string& other,
                    const std::vector<std::string>& words, Random& random) {
  std::string changed = text;
  for (int k = 1 + random.below(8); k > 0; --k) change(&changed, other, words, random);
  return changed;
}

}  // namespace host
