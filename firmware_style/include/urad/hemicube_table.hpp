// hemicube_table.hpp -- delta form factors as exact cell integrals that sum to exactly 2^32.
//
//   top    1 / (pi (1 + x^2 + y^2)^2)     [Martin 1996, Eq. 2.7]
//   side   z / (pi (1 + y^2 + z^2)^2)     [Eq. 2.8, corrected]
//
// Both integrate in closed form (the factor from a point to a rectangle), so that a table is as
// good as its rounding; midpoint values would sum to 1 + 0.54/R^2. Double arithmetic, for compile
// time and for the host: no program on a chip calls anything in this file at run time.
#pragma once
#include "urad/hemicube.hpp"

namespace urad {

namespace table {

/// sqrt x for 1 <= x <= 3: Newton from a chord, relative error <= 3e-16.
constexpr double sqrt_near_one(double x) {
  double y = 0.6 + 0.4 * x;
  for (int n = 0; n < 5; ++n) y = 0.5 * (y + x / y);
  return y;
}

/// atan t for |t| <= 1/2, series after one halving of the angle: |tan(angle/2)| <= 0.236, 16 terms
/// leave 1e-21.
constexpr double atan_half(double t) {
  const double u = t / (1 + sqrt_near_one(1 + t * t)), u2 = u * u;
  double sum = 0;
  for (int n = 31; n > 0; n -= 2) sum = sum * u2 + (n % 4 == 1 ? 1.0 : -1.0) / n;
  return 2 * u * sum;
}

inline constexpr double kPi = 4 * (2 * atan_half(1.0 / 3) + atan_half(1.0 / 7));

/// atan t for |t| <= 1, error <= 4e-16: atan t = 2 atan(t / (1 + sqrt(1 + t^2))).
constexpr double atan_unit(double t) { return 2 * atan_half(t / (1 + sqrt_near_one(1 + t * t))); }

/// Form factor from the origin, facing up, to the rectangle [0,x] x [0,y] at height 1.
constexpr double top_corner(double x, double y) {
  const double a = sqrt_near_one(1 + x * x), b = sqrt_near_one(1 + y * y);
  return (x / a * atan_unit(y / a) + y / b * atan_unit(x / b)) / (2 * kPi);
}

/// The same to [0,y] x [0,z] in the plane at distance 1 that stands upright, but for a term of y
/// alone, which the difference over a cell removes.
constexpr double side_corner(double y, double z) {
  const double a = sqrt_near_one(1 + z * z);
  return -atan_unit(y / a) / a / (2 * kPi);
}

/// Number of cells with the same value by symmetry: 8 for all but the diagonal of the top.
constexpr uint32_t orbit(bool top, int row, int column) { return top && row == column ? 4 : 8; }

}  // namespace table

/// Doubles of scratch that fill_hemicube_cells() needs.
constexpr size_t hemicube_scratch(int resolution) {
  return size_t(resolution) * size_t(resolution) / 2;
}

namespace table {

/// Exact integrals of all cells of one quadrant, times 2^32.
constexpr void integrate_cells(bool top, int half, double* exact) {
  const auto corner = [=](int column, int row) {
    const double a = double(column) / half, b = double(row) / half;
    return top ? top_corner(a, b) : side_corner(a, b);
  };
  for (int row = 0; row < half; ++row) {
    double low = corner(0, row), high = corner(0, row + 1);
    for (int column = 0; column < half; ++column) {
      const double next_low = corner(column + 1, row), next_high = corner(column + 1, row + 1);
      exact[row * half + column] = ((next_high - high) - (next_low - low)) * 4294967296.0;
      low = next_low, high = next_high;
    }
  }
}

/// Cells that leave a remainder above `limit`, in units of 2^-32 of the whole half cube.
constexpr uint64_t remaining_above(bool top, int half, const double* rest, double limit) {
  uint64_t sum = 0;
  for (int row = 0; row < half; ++row) {
    for (int column = top ? row : 0; column < half; ++column) {
      if (rest[row * half + column] > limit) sum += orbit(top, row, column);
    }
  }
  return sum;
}

/// Adds 1 to the orbits with a remainder above `limit` as long as there is something to give away.
constexpr void round_up(bool top, int half, double limit, double* rest, uint32_t* cells,
                        uint64_t* missing) {
  for (int row = 0; row < half; ++row) {
    for (int column = top ? row : 0; column < half; ++column) {
      const int k = row * half + column;
      const uint32_t share = orbit(top, row, column);
      if (rest[k] <= limit || *missing < share) continue;
      rest[k] = -1;
      *missing -= share;
      ++cells[k];
      if (share == 8 && top) ++cells[column * half + row];
    }
  }
}

}  // namespace table

/// Writes both tables, (R/2)^2 cells each. R even, 2 <= R <= 1024. Rounded by largest remainder
/// over the orbits of the symmetry: every cell is within 1 of its exact value times 2^32, and 4
/// sum(top) + 8 sum(side) = 2^32.
constexpr void fill_hemicube_cells(int resolution, double* scratch, uint32_t* top, uint32_t* side) {
  const int half = resolution / 2;
  double* const rest[2] = {scratch, scratch + half * half};
  uint32_t* const cells[2] = {side, top};
  uint64_t missing = uint64_t{1} << 32;
  for (int t = 0; t < 2; ++t) {
    table::integrate_cells(t, half, rest[t]);
    for (int row = 0; row < half; ++row) {
      for (int column = 0; column < half; ++column) {
        const int k = row * half + column, mirror = column * half + row;
        if (t && column < row) {
          cells[t][k] = cells[t][mirror];
          continue;
        }
        cells[t][k] = uint32_t(rest[t][k]);
        rest[t][k] -= cells[t][k];
        missing -= uint64_t{cells[t][k]} * table::orbit(t, row, column);
      }
    }
  }

  // The remainder above which there are just too few orbits, by bisection; then those above, those
  // at it, any.
  double low = 0, high = 1;
  for (int n = 0; n < 50; ++n) {
    const double middle = (low + high) / 2;
    const uint64_t above = table::remaining_above(false, half, rest[0], middle) +
                           table::remaining_above(true, half, rest[1], middle);
    (above > missing ? low : high) = middle;
  }
  const double limits[3] = {high, low, -0.5};
  for (const double limit : limits) {
    for (int t = 0; t < 2; ++t) table::round_up(t, half, limit, rest[t], cells[t], &missing);
  }
}

/// Both quadrants, held by value.
template <int R>
struct HemicubeCells {
  static_assert(R % 2 == 0 && R >= kHemicubeMinResolution && R <= kHemicubeMaxResolution);
  uint32_t top[R * R / 4];
  uint32_t side[R * R / 4];
};

/// The tables of resolution R; meant for a constexpr variable: 2 R^2 bytes of ROM.
template <int R>
constexpr HemicubeCells<R> make_hemicube_table() {
  HemicubeCells<R> cells{};
  double scratch[hemicube_scratch(R)] = {};
  fill_hemicube_cells(R, scratch, cells.top, cells.side);
  return cells;
}

/// The view of a table that the engine takes; `cells` must outlive it.
template <int R>
constexpr HemicubeTable hemicube_table(const HemicubeCells<R>& cells) {
  return {R, cells.top, cells.side};
}

}  // namespace urad
