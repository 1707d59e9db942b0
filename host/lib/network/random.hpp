// Random numbers that are the same on every platform: std::mt19937_64 is specified bit for bit, the
// standard distributions are not.
#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace host {

class Random {
 public:
  /// Streams of one seed are independent of each other.
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
      : engine_(seed * 0x9E3779B97F4A7C15u + stream * 0xD1B54A32D192ED03u + 1) {}

  /// Uniform in [0, 1).
  double uniform() { return double(engine_() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform on a logarithmic scale, 0 < low < high.
  double log_uniform(double low, double high) { return low * std::pow(high / low, uniform()); }
  /// 0 .. count - 1.
  int below(int count) { return int(uniform() * count); }
  /// Normal, mean 0, deviation 1 (Box and Muller 1958).
  double normal() {
    const double radius = std::sqrt(-2 * std::log1p(-uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }
  template <class T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t i = items.size(); i > 1; --i)
      std::swap(items[i - 1], items[std::size_t(below(int(i)))]);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace host
