// error_guess_vectors.hpp -- error_guess.hpp four neurons at a time, in vectors of 16 bytes that every
// x86-64 has: the same integers, by the compiler's own vector types and one instruction of SSE2.
#pragma once
#include "urad/error_model.hpp"
#include "urad/sigmoid.hpp"

namespace urad {

namespace four_at_once {

using Shorts = int16_t __attribute__((vector_size(16)));
using Ints = int32_t __attribute__((vector_size(16)));

inline Shorts shorts_at(const void* at) noexcept {
  Shorts x;
  __builtin_memcpy(&x, at, sizeof x);
  return x;
}

/// x_0 y_0 + x_1 y_1, x_2 y_2 + x_3 y_3, ...
inline Ints products(Shorts x, Shorts y) noexcept { return Ints(__builtin_ia32_pmaddwd128(x, y)); }

inline Ints rounded(Ints x, int n) noexcept {
  const int32_t half = 1 << (n - 1);
  return (x + half + (x >> 31)) >> n;
}

inline int32_t total(Ints x) noexcept {
  x += __builtin_shufflevector(x, x, 2, 3, 0, 1);
  return x[0] + x[1];
}

/// The totals of four.
inline Ints totals(Ints a, Ints b, Ints c, Ints d) noexcept {
  const Ints ab =
      __builtin_shufflevector(a, b, 0, 4, 1, 5) + __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Ints cd =
      __builtin_shufflevector(c, d, 0, 4, 1, 5) + __builtin_shufflevector(c, d, 2, 6, 3, 7);
  return __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
}

/// sigma(z) - 1/2, Q0.15, as sigmoid_uq15(): |z| ends where its table does.
inline Ints half_sigmoid_q15(Ints z_q11) noexcept {
  const Ints sign = z_q11 >> 31, size = (z_q11 ^ sign) - sign;
  const Ints u = (size | (size > 32767)) & 32767, k = u >> 7, f_q7 = u & 127;
  Ints knots;  // this one and the next
  for (int lane = 0; lane < 4; ++lane) {
    int32_t two;
    __builtin_memcpy(&two, table::kSigmoid.knot + k[lane], sizeof two);
    knots[lane] = two;
  }
  const Ints chord = products(Shorts(knots) - int16_t{16384}, Shorts((f_q7 << 16) + (128 - f_q7)));
  return (((chord + 64) >> 7) ^ sign) - sign;
}

class Guess {
 public:
  Guess(const ErrorModel& model, const PairTraits& traits) noexcept
      : model_(model), many_(model.traits > kPairTraits) {
    static_assert(kPairTraits == 16 && kTraits == 26, "two vectors; another and two more");
    trait_[0] = shorts_at(traits.log2_q8);
    trait_[1] = shorts_at(traits.log2_q8 + 8);
    if (many_) {
      constexpr Shorts last_two = {0, 0, 0, 0, 0, 0, -1, -1};
      trait_[2] = shorts_at(traits.log2_q8 + 16);
      trait_[3] = shorts_at(traits.log2_q8 + kTraits - 8) & last_two;
    }
    linear_q8_ = model.bias_q8 + model.shift_q8[int(traits.pair_class)] +
                 round_shift(total(sums(model.skip_q10)), 10);
  }

  int32_t linear_q8() const noexcept { return linear_q8_; }

  /// Output weights of four neurons, each twice.
  Shorts out_q8(int h) const noexcept {
    const Shorts out = shorts_at(model_.out_q8 + (h & 8));
    return h & 4 ? __builtin_shufflevector(out, out, 4, 4, 5, 5, 6, 6, 7, 7)
                 : __builtin_shufflevector(out, out, 0, 0, 1, 1, 2, 2, 3, 3);
  }

  /// What four neurons with these output weights add.
  Ints neurons_q8(int h, Shorts out) const noexcept {
    const auto& weight = model_.weight_q10;
    const Ints z_q18 =
        Ints(shorts_at(model_.hidden_bias_q18 + h)) +
        totals(sums(weight[h]), sums(weight[h + 1]), sums(weight[h + 2]), sums(weight[h + 3]));
    const Ints half_q15 = half_sigmoid_q15(rounded(z_q18, 7));
    return rounded(products(out, Shorts((half_q15 << 16) | 16384)), 15);
  }

 private:
  /// Four parts of weights times traits.
  Ints sums(const int16_t* weight) const noexcept {
    const Ints sum =
        products(shorts_at(weight), trait_[0]) + products(shorts_at(weight + 8), trait_[1]);
    if (!many_) return sum;
    return sum + products(shorts_at(weight + 16), trait_[2]) +
           products(shorts_at(weight + kTraits - 8), trait_[3]);
  }

  const ErrorModel& model_;
  bool many_;
  Shorts trait_[4] = {};
  int32_t linear_q8_;
};

inline int32_t error_q8(const ErrorModel& model, const PairTraits& traits) noexcept {
  const Guess guess(model, traits);
  Ints added = {0, 0, 0, 0};
  for (int h = 0; h < kErrorHidden; h += 4) added += guess.neurons_q8(h, guess.out_q8(h));
  return guess.linear_q8() + total(added);
}

inline bool error_within(const ErrorModel& model, const PairTraits& traits,
                         int32_t most_q8) noexcept {
  const Guess guess(model, traits);
  Ints falls = {0, 0, 0, 0}, rises = falls;
  constexpr Shorts ones = {1, 1, 1, 1, 1, 1, 1, 1};
  for (int h = 0; h < kErrorHidden; h += 8) {
    const Shorts out = shorts_at(model.out_q8 + h), fall = out & (out >> 15);
    falls += products(fall, ones);
    rises += products(out - fall, ones);
  }
  int32_t low = guess.linear_q8() + total(falls), high = guess.linear_q8() + total(rises);
  for (int h = 0; low <= most_q8 && high > most_q8; h += 4) {
    const Shorts twice = guess.out_q8(h);
    const Ints out = Ints(twice) >> 16, fall = out & (out >> 31);
    const Ints added = guess.neurons_q8(h, twice);
    low += total(added - fall);
    high += total(added - (out - fall));
  }
  return high <= most_q8;
}

}  // namespace four_at_once

}  // namespace urad
