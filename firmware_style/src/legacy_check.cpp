#include "crc32.hpp"
#include "urad/legacy.hpp"
#include "urad/q.hpp"

namespace urad {

namespace {

constexpr uint16_t kFlags = URAD_LEGACY_PROVEN | URAD_LEGACY_LOG;
// Steps along a grid are rounded: 2^-24 each, 65535 of them at most in either direction.
constexpr int64_t kReach_q23 = INT32_MAX - 65536;
constexpr int64_t kProven_q23 = int64_t{16} << 23;

/// |z_h| at most, for coordinates in [0, 1].
int64_t reach_q23(const urad_legacy_net& net, int h) noexcept {
  int64_t sum = 0;
  for (int n = 0; n < URAD_LEGACY_INPUTS; ++n)
    sum += magnitude(int32_t{net.hidden_weight[h * URAD_LEGACY_INPUTS + n]});
  const int shift = 23 - net.hidden_shift[h];
  return (shift >= 0 ? sum << shift : (sum >> -shift) + 1) + magnitude(net.hidden_bias[h]);
}

bool sums_fit(const urad_legacy_net& net) noexcept {
  int64_t output = magnitude(net.output_bias);
  for (int h = 0; h < net.hidden; ++h) {
    if (net.hidden_shift[h] > 24) return false;
    const int64_t z = reach_q23(net, h);
    if (z > kReach_q23 || ((net.flags & URAD_LEGACY_PROVEN) && z > kProven_q23 - 65536))
      return false;
    output += int64_t{magnitude(int32_t{net.output_weight[h]})} << 15;
  }
  return output <= INT32_MAX;
}

}  // namespace

uint32_t legacy_crc32(const urad_legacy_net& net) noexcept {
  Crc32 crc;
  crc.half(net.abi), crc.half(net.flags);
  crc.byte(net.hidden), crc.byte(net.output_shift);
  crc.byte(net.reserved[0]), crc.byte(net.reserved[1]);
  for (int k = 0; k < net.hidden * URAD_LEGACY_INPUTS; ++k)
    crc.half(uint32_t(int32_t{net.hidden_weight[k]}));
  for (int h = 0; h < net.hidden; ++h) crc.byte(net.hidden_shift[h]);
  for (int h = 0; h < net.hidden; ++h) crc.word(uint32_t(net.hidden_bias[h]));
  for (int h = 0; h < net.hidden; ++h) crc.half(uint32_t(int32_t{net.output_weight[h]}));
  crc.word(uint32_t(net.output_bias));
  return crc.value();
}

Status legacy_check(const urad_legacy_net* net) noexcept {
  if (!net) return Status::bad_argument;
  if (net->abi != URAD_LEGACY_ABI || (net->flags & ~kFlags)) return Status::bad_net;
  if (net->reserved[0] || net->reserved[1] || net->output_shift > 15) return Status::bad_net;
  if (net->hidden < 1 || net->hidden > URAD_LEGACY_MAX_HIDDEN) return Status::bad_net;
  if (!net->hidden_weight || !net->hidden_shift || !net->hidden_bias || !net->output_weight)
    return Status::bad_net;
  if (!sums_fit(*net)) return Status::bad_net;
  return legacy_crc32(*net) == net->crc32 ? Status::ok : Status::bad_net;
}

}  // namespace urad
