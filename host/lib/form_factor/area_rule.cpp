#include "form_factor/area_rule.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.hpp"
#include "geometry/triangulate.hpp"

namespace host {
namespace {

/// All rules in one row: rule n starts at n (n - 1) / 2.
using Table = std::array<GaussPoint, kMaxGaussPoints*(kMaxGaussPoints + 1) / 2>;

/// Legendre's P_n and its derivative at x, by the three-term recurrence.
std::pair<long double, long double> legendre(int n, long double x) {
  long double before = 1;
  long double value = x;
  for (int k = 2; k <= n; ++k) {
    const long double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
    before = value;
    value = next;
  }
  return {value, n * (x * value - before) / (x * x - 1)};
}

Table make_table() {
  Table table{};
  auto out = table.begin();
  for (int n = 1; n <= kMaxGaussPoints; ++n)
    for (int k = 0; k < n; ++k) {
      // Tricomi's start is within the basin of every root; Newton then doubles the digits.
      long double x = -std::cos(std::numbers::pi_v<long double> * (k + 0.75L) / (n + 0.5L));
      for (int step = 0; step < 8 && n > 1; ++step) {
        const auto [value, slope] = legendre(n, x);
        x -= value / slope;
      }
      if (2 * k + 1 == n) x = 0;
      const long double slope = n > 1 ? legendre(n, x).second : 1;
      *out++ = {static_cast<double>(x), static_cast<double>(2 / ((1 - x * x) * slope * slope))};
    }
  return table;
}

void add_quad(const Loop& v, const Vec3& normal, std::span<const GaussPoint> rule,
              std::vector<AreaPoint>* points) {
  for (const GaussPoint& gu : rule)
    for (const GaussPoint& gv : rule) {
      const double s = 0.5 * (1 + gu.x);
      const double t = 0.5 * (1 + gv.x);
      const Vec3 du = (1 - t) * (v[1] - v[0]) + t * (v[2] - v[3]);
      const Vec3 dv = (1 - s) * (v[3] - v[0]) + s * (v[2] - v[1]);
      const Vec3 x = v[0] + s * (v[1] - v[0]) + t * dv;
      points->push_back({x, 0.25 * gu.weight * gv.weight * glm::dot(normal, glm::cross(du, dv))});
    }
}

void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal,
                  std::span<const GaussPoint> rule, std::vector<AreaPoint>* points) {
  const double doubled = glm::dot(normal, glm::cross(b - a, c - a));
  for (const GaussPoint& gu : rule)
    for (const GaussPoint& gv : rule) {
      const double s = 0.5 * (1 + gu.x);
      const double t = 0.5 * (1 + gv.x);
      points->push_back(
          {a + s * ((b - a) + t * (c - b)), 0.25 * gu.weight * gv.weight * s * doubled});
    }
}

/// A convex loop: quadrilaterals fanned from the first corner, and a triangle where one corner is
/// over.
void add_convex(const Loop& v, const Vec3& normal, std::span<const GaussPoint> rule,
                std::vector<AreaPoint>* points) {
  std::size_t k = 1;
  for (; k + 2 < v.size(); k += 2) add_quad({v[0], v[k], v[k + 1], v[k + 2]}, normal, rule, points);
  if (k + 1 < v.size()) add_triangle(v[0], v[k], v[k + 1], normal, rule, points);
}

std::vector<Loop> convex_pieces(const Polygon& polygon) {
  if (is_convex_quad(polygon)) return {polygon.outer};
  std::vector<Loop> pieces;
  for (const Triangle& t : triangulate(polygon)) pieces.push_back({t[0], t[1], t[2]});
  return pieces;
}

}  // namespace

std::span<const GaussPoint> gauss_rule(int n) {
  if (n < 1 || n > kMaxGaussPoints)
    throw Error("a rule of " + std::to_string(n) + " points; 1 to " +
                std::to_string(kMaxGaussPoints) + " are there");
  static const Table kTable = make_table();
  return {kTable.data() + n * (n - 1) / 2, static_cast<std::size_t>(n)};
}

std::vector<AreaPoint> area_points(const Polygon& polygon, int n) {
  const std::span<const GaussPoint> rule = gauss_rule(n);
  const Vec3 normal = moments(polygon).normal;
  std::vector<AreaPoint> points;
  for (const Loop& piece : convex_pieces(polygon)) add_convex(piece, normal, rule, &points);
  return points;
}

std::vector<AreaPoint> area_points(const Polygon& polygon, int n, const Vec3& point,
                                   const Vec3& normal) {
  const std::span<const GaussPoint> rule = gauss_rule(n);
  const Vec3 own_normal = moments(polygon).normal;
  std::vector<AreaPoint> points;
  for (const Loop& piece : convex_pieces(polygon))
    add_convex(clip({piece, {}}, point, normal).outer, own_normal, rule, &points);
  return points;
}

}  // namespace host
