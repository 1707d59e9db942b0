// pair.hpp for many pairs at once: one patch with a vector of others. Names and formulas as there.
#if defined(URAD_LANES_PAIR) == defined(HWY_TARGET_TOGGLE)
#ifdef URAD_LANES_PAIR
#undef URAD_LANES_PAIR
#else
#define URAD_LANES_PAIR
#endif

#include "lanes/fixed_math-inl.hpp"
#include "lanes/patch_lanes.hpp"
#include "urad/pair.hpp"

HWY_BEFORE_NAMESPACE();
namespace host::HWY_NAMESPACE {

struct Vec15 {
  Ints x, y, z;
};

HWY_INLINE Ints dot_q30(const Vec15& a, const Vec15& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

struct PatchVector {
  Ints centroid[3], normal_q30[3], spread_q15[6], log2_area, log2_spread, log2_scale, fill_q15;
  Vec15 normal_q15;
};

template <class Load>
HWY_INLINE PatchVector patch_vector(Load&& load) {
  PatchVector p;
  for (int k = 0; k < 3; ++k) {
    p.centroid[k] = load(PatchLanes::centroid + k);
    p.normal_q30[k] = load(PatchLanes::normal + k);
  }
  for (int k = 0; k < 6; ++k) p.spread_q15[k] = load(PatchLanes::spread + k);
  p.log2_area = load(PatchLanes::log2_area);
  p.log2_spread = load(PatchLanes::log2_spread);
  p.log2_scale = load(PatchLanes::log2_scale);
  p.fill_q15 = load(PatchLanes::fill);
  p.normal_q15 = {round_shift<15>(p.normal_q30[0]), round_shift<15>(p.normal_q30[1]),
                  round_shift<15>(p.normal_q30[2])};
  return p;
}

/// Patch i in every lane.
HWY_INLINE PatchVector broadcast(const PatchLanes& patches, std::size_t i) {
  return patch_vector([&](int row) { return ints(patches.row(row)[i]); });
}
/// Patches from `first` on, one a lane.
HWY_INLINE PatchVector load(const PatchLanes& patches, std::size_t first) {
  return patch_vector([&](int row) { return hn::LoadU(kInts, patches.row(row) + first); });
}

struct SideVector {
  Ints log2_cosine_q24, log2_slope_q24, log2_cosine_other_q24, along_q22, across_q22;
  Words size_uq22;
};

struct PairVector {
  IntMask facing;  ///< each centroid in front of the other's plane; the rest is undefined elsewhere
  Ints log2_kernel_q24, log2_bend_q24;
  Words rho_uq22;
  SideVector side[2];
};

HWY_INLINE Words square_high(Ints x) {
  const Words a = hn::ShiftRight<16>(magnitude(x)), b = hn::And(magnitude(x), words(0xFFFF));
  return hn::Add(hn::Mul(a, a), hn::ShiftRight<15>(hn::Mul(a, b)));
}

HWY_INLINE Words limited(Words x_uq22) { return hn::Min(x_uq22, words(urad::kSizeLimit_uq22)); }

HWY_INLINE Ints scaled_q22(Words x_uq22, Ints y_q15) {
  return mul_round<15>(as_ints(x_uq22), y_q15);
}

HWY_INLINE Vec15 spread_times(const PatchVector& patch, const Vec15& v) {
  const Ints* m = patch.spread_q15;
  const auto row = [&](Ints a, Ints b, Ints c) { return round_shift<15>(dot_q30({a, b, c}, v)); };
  return {row(m[0], m[3], m[4]), row(m[3], m[1], m[5]), row(m[4], m[5], m[2])};
}

/// toward: +1 when w points from the other patch's lit side, -1 when to it: the sign of m.w.
HWY_INLINE SideVector look(const PatchVector& patch, Ints log2_distance2_q24, const Vec15& w,
                           const Vec15& m, int toward, Ints log2_cosine_q24,
                           Ints log2_cosine_other_q24) {
  SideVector side;
  const Ints log2_size_q24 = hn::Sub(patch.log2_spread, log2_distance2_q24);
  const Vec15 mw = spread_times(patch, w);
  const Ints c_q15 = round_shift<15>(dot_q30(mw, m));
  side.log2_cosine_q24 = log2_cosine_q24;
  side.log2_cosine_other_q24 = log2_cosine_other_q24;
  side.log2_slope_q24 = hn::Sub(log2_size_q24, log2_cosine_other_q24);
  side.size_uq22 = limited(exp2_uq(log2_size_q24, 22));
  side.along_q22 = scaled_q22(side.size_uq22, round_shift<15>(dot_q30(mw, w)));
  side.across_q22 =
      scaled_q22(limited(exp2_uq(side.log2_slope_q24, 22)), toward < 0 ? hn::Neg(c_q15) : c_q15);
  return side;
}

HWY_INLINE Ints t2_q22(const SideVector& side) {
  return hn::Sub(
      hn::Sub(hn::Mul(side.along_q22, ints(12)), hn::ShiftLeft<1>(as_ints(side.size_uq22))),
      hn::ShiftLeft<2>(side.across_q22));
}

HWY_INLINE Ints bend_q24(Ints any_t2_q22) {
  const Ints t2_q22 =
      hn::Clamp(any_t2_q22, ints(-urad::kTermLimit_q22), ints(urad::kTermLimit_q22));
  // |T2| <= 63 in Q14 is below 2^20: its square over 2^8 from two halves of 10 bits.
  const Words t = magnitude(round_shift<8>(t2_q22));
  const Words high = hn::ShiftRight<10>(t), low = hn::And(t, words(1023));
  const Words cross = hn::ShiftLeft<11>(hn::Mul(high, low));
  const Words square_uq20 = hn::Add(hn::ShiftLeft<12>(hn::Mul(high, high)),
                                    hn::ShiftRight<8>(hn::Add(cross, hn::Mul(low, low))));
  const Words four_ninths = words(29127);
  const Words x_uq20 =
      hn::Add(hn::Mul(hn::ShiftRight<16>(square_uq20), four_ninths),
              hn::ShiftRight<16>(hn::Mul(hn::And(square_uq20, words(0xFFFF)), four_ninths)));
  const Words factor_uq15 =
      exp2_uq(hn::Sub(ints(urad::kLog2Log2E_q24), hn::ShiftRight<1>(log2_1p_q24(x_uq20, 20))), 15);
  return mul_round<13>(t2_q22, as_ints(factor_uq15));
}

HWY_INLINE PairVector pair_kernel(const PatchVector& i, const PatchVector& j) {
  PairVector pair;
  Ints r[3];
  for (int k = 0; k < 3; ++k) r[k] = hn::Sub(j.centroid[k], i.centroid[k]);
  const Words all = hn::Or(hn::Or(magnitude(r[0]), magnitude(r[1])), magnitude(r[2]));
  const Ints up = hn::Sub(ints(30), top_bit(all));
  WideSum p{}, minus_q{};
  for (int k = 0; k < 3; ++k) {
    r[k] = hn::Shl(r[k], up);
    p.add(i.normal_q30[k], r[k]);
    minus_q.add(j.normal_q30[k], r[k]);
  }
  const WideSum q = minus_q.negative();
  pair.facing = hn::And(positive(p), positive(q));

  const Words r2 = hn::Add(hn::Add(square_high(r[0]), square_high(r[1])), square_high(r[2]));
  const Ints log2_r2_q24 = hn::Add(log2_q24(r2), ints(32 << 24));
  const Ints log2_r_q24 = hn::ShiftRight<1>(log2_r2_q24);
  const Ints log2_distance2_q24 = hn::Sub(log2_r2_q24, hn::ShiftLeft<25>(up));
  const auto log2_cosine = [&](const WideSum& x) {
    return hn::Sub(hn::Sub(log2_q24(x.high(), x.low()), ints(30 << 24)), log2_r_q24);
  };
  const Ints log2_p_q24 = log2_cosine(p), log2_q_q24 = log2_cosine(q);

  const Ints inverse_uq15 = as_ints(exp2_uq(hn::Sub(ints(16 << 24), log2_r_q24), 30));
  const auto direction = [&](Ints x) {
    return round_shift<15>(hn::Mul(round_shift<16>(x), inverse_uq15));
  };
  const Vec15 w{direction(r[0]), direction(r[1]), direction(r[2])};
  pair.side[0] = look(i, log2_distance2_q24, w, j.normal_q15, -1, log2_p_q24, log2_q_q24);
  pair.side[1] = look(j, log2_distance2_q24, w, i.normal_q15, 1, log2_q_q24, log2_p_q24);

  pair.rho_uq22 = hn::Add(pair.side[0].size_uq22, pair.side[1].size_uq22);
  pair.log2_kernel_q24 =
      hn::Sub(hn::Add(hn::Add(hn::Sub(i.log2_area, log2_distance2_q24), j.log2_area),
                      hn::Add(log2_p_q24, log2_q_q24)),
              ints(urad::kLog2Pi_q24));
  pair.log2_bend_q24 = bend_q24(hn::Add(t2_q22(pair.side[0]), t2_q22(pair.side[1])));
  return pair;
}

HWY_INLINE Ints narrow_q15(Ints x) { return hn::Max(hn::Min(x, ints(32767)), ints(-32767)); }

HWY_INLINE Ints slant_q15(const PatchVector& patch, const SideVector& side, const Vec15& m) {
  const Ints mm_q15 = round_shift<15>(dot_q30(spread_times(patch, m), m));
  const Words steep_uq22 =
      limited(exp2_uq(hn::Sub(side.log2_slope_q24, side.log2_cosine_other_q24), 22));
  const Words t_uq22 = as_words(scaled_q22(steep_uq22, hn::Max(mm_q15, hn::Zero(kInts))));
  return narrow_q15(hn::Sub(ints(32768), as_ints(exp2_uq(hn::Neg(log2_1p_q24(t_uq22, 22)), 15))));
}

/// The order of the two that urad::pair_inputs() chooses: true where x comes first.
HWY_INLINE IntMask comes_first(const PatchVector& a, const SideVector& x, Ints slant_x,
                               const PatchVector& b, const SideVector& y, Ints slant_y) {
  IntMask first = hn::Not(hn::Lt(a.fill_q15, b.fill_q15));
  const auto before_that = [&](Ints u, Ints v) {
    first = hn::Or(hn::Gt(u, v), hn::And(hn::Eq(u, v), first));
  };
  before_that(slant_x, slant_y);
  before_that(x.across_q22, y.across_q22);
  before_that(x.along_q22, y.along_q22);
  before_that(as_ints(x.size_uq22), as_ints(y.size_uq22));
  before_that(x.log2_cosine_q24, y.log2_cosine_q24);
  before_that(a.log2_area, b.log2_area);
  return first;
}

HWY_INLINE void pair_inputs(const PatchVector& i, const PatchVector& j, const PairVector& pair,
                            Ints* gate_uq16, Ints* input_q15) {
  const SideVector &x = pair.side[0], &y = pair.side[1];
  const Ints slant_x = slant_q15(i, x, j.normal_q15), slant_y = slant_q15(j, y, i.normal_q15);
  const IntMask first = comes_first(i, x, slant_x, j, y, slant_y);
  const Words shrink_uq16 = exp2_uq(hn::Neg(log2_1p_q24(pair.rho_uq22, 22)), 16);
  const Words gate = hn::Sub(words(65536), shrink_uq16);
  *gate_uq16 = as_ints(hn::ShiftRight<16>(hn::Mul(gate, gate)));

  const auto put = [&](int at, Ints of_i, Ints of_j) {  // a quantity of the first and of the second
    input_q15[3 + at] = hn::IfThenElse(first, of_i, of_j);
    input_q15[8 + at] = hn::IfThenElse(first, of_j, of_i);
  };
  const auto cosine = [](const SideVector& side) {
    return narrow_q15(as_ints(exp2_uq(side.log2_cosine_q24, 15)));
  };
  const auto shrunk = [&](Ints a_q22) { return narrow_q15(mul_shift(a_q22, shrink_uq16, 23)); };
  input_q15[0] = hn::IfThenElse(first, cosine(x), cosine(y));
  input_q15[1] = hn::IfThenElse(first, cosine(y), cosine(x));
  input_q15[2] = narrow_q15(round_shift<15>(dot_q30(i.normal_q15, j.normal_q15)));
  put(0, shrunk(as_ints(x.size_uq22)), shrunk(as_ints(y.size_uq22)));
  put(1, shrunk(x.along_q22), shrunk(y.along_q22));
  put(2, shrunk(x.across_q22), shrunk(y.across_q22));
  put(3, slant_x, slant_y);
  put(4, narrow_q15(i.fill_q15), narrow_q15(j.fill_q15));
  input_q15[13] = narrow_q15(round_shift<11>(pair.log2_bend_q24));
}

}  // namespace host::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
