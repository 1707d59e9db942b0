// libFuzzer: wrong arguments to every entry of the engine.
#include <cstddef>
#include <cstdint>

#include "must_hold.hpp"
#include "stress/scene_entries.hpp"
#include "weights/general.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  host::Findings findings;
  host::attack_arguments(host::Choices(bytes), urad_general, &findings);
  must_hold(findings);
  return 0;
}
