#include "urad/grid.hpp"

#include "urad/log2.hpp"
#include "urad/vec.hpp"

namespace urad {

namespace {

struct Wide {
  int64_t x, y, z;
};

Wide cross(const urad_point& a, const urad_point& b) noexcept {
  return {wide_mul(a.y, b.z) - wide_mul(a.z, b.y), wide_mul(a.z, b.x) - wide_mul(a.x, b.z),
          wide_mul(a.x, b.y) - wide_mul(a.y, b.x)};
}

/// x with its greatest component in [2^29, 2^30); *shift is how far it was moved down.
urad_point normalised(const Wide& x, int* shift) noexcept {
  *shift = top_bit(magnitude(x.x) | magnitude(x.y) | magnitude(x.z)) - 29;
  const int down = *shift;
  const auto move = [=](int64_t c) {
    return int32_t(down > 0 ? shift_down(c, down) : c * (int64_t{1} << -down));
  };
  return {move(x.x), move(x.y), move(x.z)};
}

/// x / |x| in Q2.30 for a normalised x: the table's reciprocal root and one Newton step.
urad_point unit_q30(const urad_point& x) noexcept {
  const int64_t length2_uq28 =
      int64_t(uint64_t(dot(x, x)) >> 30);  // |x|^2 / 2^58, 1/4 .. 3 in UQ.28 and 2^28 = 1
  const int64_t y_q28 = rsqrt_uq(uint64_t(length2_uq28), 42);  // 2^28 / sqrt(|x|^2 / 2^58 )
  const int64_t half_q28 = round_shift(round_shift(y_q28 * y_q28, 28) * length2_uq28, 28);
  const int64_t better_q28 = round_shift(y_q28 * ((int64_t{3} << 28) - half_q28), 29);
  const auto scaled = [=](int32_t c) {
    constexpr int32_t one = int32_t{1} << 30;  // rounding may pass it
    const int64_t along = round_shift(c * better_q28, 27);
    return along > one ? one : along < -one ? -one : int32_t(along);
  };
  return {scaled(x.x), scaled(x.y), scaled(x.z)};
}

bool inside(int64_t x) noexcept { return x >= -URAD_COORDINATE_MAX && x <= URAD_COORDINATE_MAX; }

/// All four corners of the grid along one axis.
bool reaches(int32_t origin, int32_t step_u, int32_t step_v, uint16_t count_u,
             uint16_t count_v) noexcept {
  const int64_t u = wide_mul(step_u, count_u), v = wide_mul(step_v, count_v);
  return inside(origin) && inside(origin + u) && inside(origin + v) && inside(origin + u + v);
}

/// M = (u u^T + v v^T) / 12 of a parallelogram, over its trace.
void put_spread(const urad_point& u, const urad_point& v, int32_t log2_sum_q24,
                int16_t* spread_q15) noexcept {
  const int32_t a[3] = {u.x, u.y, u.z}, b[3] = {v.x, v.y, v.z};
  constexpr int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
  for (int k = 0; k < 6; ++k) {
    const int64_t product = wide_mul(a[row[k]], a[column[k]]) + wide_mul(b[row[k]], b[column[k]]);
    const uint32_t size_q15 =
        product == 0 ? 0 : exp2_uq(log2_q24(magnitude(product)) - log2_sum_q24, 15);
    const int16_t narrow = int16_t(size_q15 > 32767u ? 32767u : size_q15);
    spread_q15[k] = product < 0 ? int16_t(-narrow) : narrow;
  }
}

}  // namespace

Status grid_make(const urad_point& origin, const urad_point& step_u, const urad_point& step_v,
                 uint16_t count_u, uint16_t count_v, urad_grid* grid) noexcept {
  if (!grid || count_u == 0 || count_v == 0) return Status::bad_argument;
  if (!reaches(origin.x, step_u.x, step_v.x, count_u, count_v) ||
      !reaches(origin.y, step_u.y, step_v.y, count_u, count_v) ||
      !reaches(origin.z, step_u.z, step_v.z, count_u, count_v)) {
    return Status::bad_argument;
  }
  const Wide area = cross(step_u, step_v);
  if (area.x == 0 && area.y == 0 && area.z == 0) return Status::bad_argument;

  int shift;
  const urad_point along = normalised(area, &shift);
  const uint64_t sum = uint64_t(dot(step_u, step_u)) + uint64_t(dot(step_v, step_v));
  constexpr int32_t log2_12_q24 = int32_t(3.5849625007211562 * 16777216 + 0.5);
  const int32_t log2_sum_q24 = log2_q24(sum);

  urad_shape shape{};
  shape.normal_q30 = unit_q30(along);
  shape.log2_area_q24 = shift_down(log2_q24(uint64_t(dot(along, along))), 1) + shift * (1 << 24);
  shape.log2_spread_q24 = log2_sum_q24 - log2_12_q24;
  put_spread(step_u, step_v, log2_sum_q24, shape.spread_q15);
  const uint32_t thin_uq20 = exp2_uq(log2_sum_q24 - shape.log2_area_q24, 20);
  constexpr uint32_t most = uint32_t{1} << 31;  // 12 tr M / A at most: the fill is then 2^-11
  shape.fill_uq15 = uint16_t(exp2_uq(-log2_1p_q24(thin_uq20 < most ? thin_uq20 : most, 20), 15));
  *grid = {origin, step_u, step_v, count_u, count_v, shape};
  return Status::ok;
}

}  // namespace urad
