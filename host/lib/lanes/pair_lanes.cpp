#include "lanes/pair_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lanes/pair_lanes.cpp"
#include <hwy/foreach_target.h>
// What follows is compiled once per instruction set.
#include "lanes/fixed_math-inl.hpp"
#include "lanes/network-inl.hpp"
#include "lanes/pair-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace host::HWY_NAMESPACE {

void factors(const PatchLanes& patches, std::uint16_t i, std::uint16_t first, std::uint16_t count,
             urad::Kernel kernel, const urad_net* net, LaneFactors* out) {
  const PatchVector from = broadcast(patches, i);
  for (std::size_t k = 0; k < count; k += hn::Lanes(kInts)) {
    const PatchVector to = load(patches, std::size_t{first} + k);
    const PairVector pair = pair_kernel(from, to);
    const Words rho_uq16 = hn::ShiftRight<6>(pair.rho_uq22);
    Ints g = pair.log2_kernel_q24;
    if (kernel == urad::Kernel::moment) g = hn::Add(g, pair.log2_bend_q24);
    if (net) {
      const IntMask far = hn::Lt(as_ints(rho_uq16), ints(net->far_rho_uq16));
      if (!hn::AllTrue(kInts, far)) {
        Ints gate_uq16, input_q15[urad::kPairInputs];
        pair_inputs(from, to, pair, &gate_uq16, input_q15);
        const Ints correction = word_q24(network_run(*net, input_q15), gate_uq16);
        g = hn::Add(g, hn::IfThenZeroElse(far, correction));
      }
    }
    g = hn::Min(g, hn::Min(from.log2_area, to.log2_area));
    g = hn::Add(g, hn::Add(from.log2_scale, to.log2_scale));
    const auto store = [&](Ints x, Ints otherwise, std::vector<std::uint32_t>& row) {
      hn::StoreU(as_words(hn::IfThenElse(pair.facing, x, otherwise)), kWords, row.data() + k);
    };
    const auto factor = [&](const PatchVector& of) {
      return as_ints(exp2_uq(hn::Sub(g, of.log2_area), 32));
    };
    store(factor(from), hn::Zero(kInts), out->from_uq32);
    store(factor(to), hn::Zero(kInts), out->to_uq32);
    store(as_ints(rho_uq16), ints(std::int32_t(LaneFactors::kNotFacing)), out->rho_uq16);
  }
}

}  // namespace host::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace host {

HWY_EXPORT(factors);

void lane_factors(const PatchLanes& patches, std::uint16_t i, std::uint16_t first,
                  std::uint16_t count, urad::Kernel kernel, const urad_net* net, LaneFactors* out) {
  const std::size_t room = std::size_t{count} + PatchLanes::kPadding;
  for (auto* row : {&out->from_uq32, &out->to_uq32, &out->rho_uq16})
    if (row->size() < room) row->resize(room);
  HWY_DYNAMIC_DISPATCH(factors)(patches, i, first, count, kernel, net, out);
}

}  // namespace host
#endif
