#include "stress/attacks.hpp"
#include "stress/scene_entries.hpp"

namespace host {
namespace {

std::string random_bytes(Random& random) {
  std::string bytes(std::size_t(random.log_uniform(32, 2048)), '\0');
  for (char& c : bytes) c = char(random.below(256));
  return bytes;
}

}  // namespace

std::vector<Attack> scene_attacks(const NetChoice& nets) {
  return {{"scenes", "random and mutated", random_bytes,
           [nets](const std::string& input, Findings* findings) {
             attack_engine(Choices(input), nets.find("general"), findings);
           }},
          {"scenes", "wrong arguments", random_bytes,
           [nets](const std::string& input, Findings* findings) {
             attack_arguments(Choices(input), nets.find("general"), findings);
           }},
          {"scenes", "bit faults", random_bytes, [](const std::string& input, Findings* findings) {
             attack_bits(Choices(input), findings);
           }}};
}

}  // namespace host
