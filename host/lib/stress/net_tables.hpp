// A urad_net that owns its tables, so that every bit of it can be turned.
#pragma once
#include <cstdint>
#include <vector>

#include "network/random.hpp"
#include "urad/net.h"

namespace host {

class OpenNet {
 public:
  OpenNet(int inputs, int hidden, int weight_bits);
  /// A copy of a net that has passed its check.
  explicit OpenNet(const urad_net& net);
  OpenNet(const OpenNet&) = delete;
  OpenNet& operator=(const OpenNet&) = delete;

  /// Its pointers follow the tables; to be asked again after a change of sizes.
  const urad_net& pod();
  /// Sets the CRC to what the tables give.
  void seal();

  /// Every bit of every field and table but pointers, in a fixed order.
  std::size_t bits() const;
  void flip(std::size_t bit);

  urad_net fields{};
  std::vector<std::uint8_t> hidden_weight;  ///< int8_t or int16_t
  std::vector<std::int32_t> hidden_bias;
  std::vector<urad_rescale> hidden_rescale;
  std::vector<std::int16_t> output_weight, skip_weight;

 private:
  struct Bytes {
    void* data;
    std::size_t size;
  };
  std::vector<Bytes> bytes();
};

/// How hostile the numbers of a random net are.
enum class NetTemper { any, extreme, zero };

/// Sizes, weights, biases and rescales at random; sealed, so that only the numbers can be wrong.
void randomise(OpenNet* net, NetTemper temper, Random& random);

/// What network_run() must give, by 64-bit sums that cannot overflow.
std::int32_t wide_network(const urad_net& net, const std::int16_t* input_q15);

}  // namespace host
