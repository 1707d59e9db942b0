// crc32.hpp -- IEEE CRC-32 of numbers, little endian, whatever the machine.
#pragma once
#include <stdint.h>

namespace urad {

/// A nibble at a time: 64 bytes of table.
class Crc32 {
 public:
  void byte(uint32_t x) noexcept {
    state_ ^= x & 0xFFu;
    nibble();
    nibble();
  }
  void half(uint32_t x) noexcept { byte(x), byte(x >> 8); }
  void word(uint32_t x) noexcept { half(x), half(x >> 16); }
  void word(int32_t x) noexcept { word(uint32_t(x)); }
  uint32_t value() const noexcept { return ~state_; }

 private:
  void nibble() noexcept {
    constexpr uint32_t table[16] = {0x00000000, 0x1DB71064, 0x3B6E20C8, 0x26D930AC,
                                    0x76DC4190, 0x6B6B51F4, 0x4DB26158, 0x5005713C,
                                    0xEDB88320, 0xF00F9344, 0xD6D6A3E8, 0xCB61B38C,
                                    0x9B64C2B0, 0x86D3D2D4, 0xA00AE278, 0xBDBDF21C};
    state_ = table[state_ & 15u] ^ (state_ >> 4);
  }
  uint32_t state_ = 0xFFFFFFFFu;
};

}  // namespace urad
