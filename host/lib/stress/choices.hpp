// Decisions read from bytes: random ones, or those of a fuzzer that watches where they lead.
#pragma once
#include <cstdint>
#include <string_view>

namespace host {

class Choices {
 public:
  explicit Choices(std::string_view bytes) : bytes_(bytes) {}

  /// The next byte; 0 when there is none left.
  std::uint32_t byte() {
    return at_ < bytes_.size() ? static_cast<unsigned char>(bytes_[at_++]) : 0;
  }
  std::uint32_t half() {
    const std::uint32_t low = byte();
    return low | byte() << 8;
  }
  std::uint32_t word() {
    const std::uint32_t low = half();
    return low | half() << 16;
  }
  /// 0 .. count - 1, count <= 65536.
  std::uint32_t below(std::uint32_t count) { return (count > 256 ? half() : byte()) % count; }
  bool yes() { return byte() & 1; }
  bool done() const { return at_ >= bytes_.size(); }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace host
