#include "report/apng.hpp"

#include <boost/crc.hpp>
#include <cstdint>
#include <string_view>

#include "base/error.hpp"

namespace host {
namespace {

constexpr std::size_t kSignature = 8, kAround = 12;  // length and name before, CRC behind the data

std::string big_endian(std::uint32_t x, int bytes) {
  std::string text;
  for (int k = bytes - 1; k >= 0; --k) text.push_back(char(x >> (8 * k) & 0xFF));
  return text;
}

std::uint32_t number_at(std::string_view text, std::size_t at) {
  std::uint32_t x = 0;
  for (std::size_t k = 0; k < 4; ++k) x = x << 8 | std::uint8_t(text[at + k]);
  return x;
}

std::string chunk(std::string_view name, const std::string& data) {
  boost::crc_32_type crc;
  crc.process_bytes(name.data(), name.size());
  crc.process_bytes(data.data(), data.size());
  return big_endian(std::uint32_t(data.size()), 4) + std::string(name) + data +
         big_endian(crc.checksum(), 4);
}

/// The data of all chunks of that name.
std::string data_of(std::string_view png, std::string_view name) {
  std::string data;
  for (std::size_t at = kSignature; at + kAround <= png.size();) {
    const std::size_t size = number_at(png, at);
    if (png.substr(at + 4, 4) == name) data += png.substr(at + 8, size);
    at += kAround + size;
  }
  return data;
}

}  // namespace

std::string apng(const std::vector<Image>& frames, int milliseconds) {
  if (frames.empty()) throw Error("an animation needs at least one picture");
  const Image& first = frames.front();
  const std::string plain = png(first);
  std::string file = plain.substr(0, kSignature) + chunk("IHDR", data_of(plain, "IHDR")) +
                     chunk("acTL", big_endian(std::uint32_t(frames.size()), 4) + big_endian(0, 4));
  std::uint32_t sequence = 0;
  for (const Image& frame : frames) {
    if (frame.width != first.width || frame.height != first.height ||
        frame.channels != first.channels)
      throw Error("the pictures of an animation differ in size");
    const bool start = sequence == 0;
    const std::string data = data_of(start ? plain : png(frame), "IDAT");
    file += chunk("fcTL", big_endian(sequence++, 4) + big_endian(std::uint32_t(frame.width), 4) +
                              big_endian(std::uint32_t(frame.height), 4) + big_endian(0, 4) +
                              big_endian(0, 4) + big_endian(std::uint32_t(milliseconds), 2) +
                              big_endian(1000, 2) + big_endian(0, 2));
    file += start ? chunk("IDAT", data) : chunk("fdAT", big_endian(sequence++, 4) + data);
  }
  return file + chunk("IEND", "");
}

}  // namespace host
