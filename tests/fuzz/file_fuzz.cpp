// libFuzzer: any bytes through one parser (URAD_FUZZ_TARGET, a name of stress/file_targets.hpp).
#include <cstddef>
#include <cstdint>

#include "base/error.hpp"
#include "stress/file_targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const host::FileTarget& target = host::file_target(URAD_FUZZ_TARGET);
  try {
    target.read({reinterpret_cast<const char*>(data), size});
  } catch (const host::Error&) {  // what a bad file deserves; anything else ends the fuzzer
  }
  return 0;
}
