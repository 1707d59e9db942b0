#include "base/error.hpp"
#include "stress/attacks.hpp"
#include "stress/file_targets.hpp"
#include "stress/mutate.hpp"
#include "stress/watch.hpp"

namespace host {
namespace {

constexpr double kMostSeconds = 10;

/// What an altered file does to its parser: it reads it, or says in one line why not.
void read_altered(const FileTarget& target, const std::string& text, Findings* findings) {
  const double start = thread_seconds();
  bool one_line = true, ours = true;
  try {
    target.read(text);
  } catch (const Error& error) {
    one_line = std::string_view(error.what()).find('\n') == std::string_view::npos;
  } catch (const std::exception& error) {
    ours = false;
    findings->expect(std::string("no exception but Error: ") + error.what(), false);
  }
  findings->expect("no exception but Error", ours);
  findings->expect("a message of one line", one_line);
  findings->measure("seconds", thread_seconds() - start, kMostSeconds);
}

}  // namespace

std::vector<Attack> file_attacks() {
  std::vector<Attack> attacks;
  for (const FileTarget& target : file_targets()) {
    const auto pick = [&target](Random& random) -> const std::string& {
      return target.seeds[std::size_t(random.below(int(target.seeds.size())))];
    };
    attacks.push_back({"files", target.name,
                       [&target, pick](Random& random) {
                         const std::string& first = pick(random);
                         return mutated(first, pick(random), target.words, random);
                       },
                       [&target](const std::string& input, Findings* findings) {
                         read_altered(target, input, findings);
                       }});
  }
  return attacks;
}

}  // namespace host
