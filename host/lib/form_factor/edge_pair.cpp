#include "form_factor/edge_pair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "form_factor/area_rule.hpp"

namespace host {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr int kMaxPoints = 16;       // of one Gauss rule along an edge
constexpr int kTouchingPoints = 24;  // of the rule towards a common point of two edges
constexpr double kTouching =
    1e-9;                        // of a width: nearer is the same point, at an error of the square
constexpr int kMaxProduct = 36;  // of a rule along both edges
constexpr double kParallelLoss =
    64;  // the closed form for parallel edges rounds like reach^2 / (|e| |f|)
constexpr double kSmallest =
    4e-6;  // pieces of an edge below this fraction hold less than 1e-16 of its integral

/// Points that a Gauss rule needs for 1e-16 when the nearest singularity lies on the Bernstein
/// ellipse with parameter `ellipse` (sum of the half axes over the half interval): the error falls
/// like ellipse^(-2n) [Trefethen 2008].
int points_needed(double ellipse) {
  static const std::array<double, kMaxPoints + 1> kEllipse = [] {
    std::array<double, kMaxPoints + 1> least{};
    least[0] = std::numeric_limits<double>::infinity();
    for (int n = 1; n <= kMaxPoints; ++n)
      least[static_cast<std::size_t>(n)] = std::pow(1e-16, -0.5 / n);
    return least;
  }();
  int n = 1;
  while (n <= kMaxPoints && ellipse < kEllipse[static_cast<std::size_t>(n)]) ++n;
  return n;
}

/// Second antiderivative of ln sqrt(u^2 + h^2) in u, with h >= 0.
double parallel_term(double u, double h, double unit2) {
  const double r2 = u * u + h * h;
  if (!(r2 > 0)) return 0;
  return 0.25 * (u * u - h * h) * std::log(r2 / unit2) - 0.75 * u * u + h * u * std::atan2(u, h);
}

/// Edges of one direction (sign 1) or of opposite ones (-1): r depends on one difference of
/// positions.
double parallel_integral(const Edge& e, const Edge& f, double sign, double unit2) {
  const Vec3 w = f.start - e.start;
  const double h = glm::length(glm::cross(w, e.direction));
  const double near = glm::dot(w, e.direction);
  const double far = near + sign * f.length;
  const double low = std::min(near, far);
  const double high = std::max(near, far);
  return (parallel_term(high, h, unit2) - parallel_term(low, h, unit2)) -
         (parallel_term(high - e.length, h, unit2) - parallel_term(low - e.length, h, unit2));
}

/// Far edges: a product rule, in which nothing cancels.
double product_integral(const Edge& e, int ne, const Edge& f, int nf, double unit2) {
  const Vec3 w =
      (f.start + 0.5 * f.length * f.direction) - (e.start + 0.5 * e.length * e.direction);
  double sum = 0;
  for (const GaussPoint& ge : gauss_rule(ne)) {
    const Vec3 x = w - 0.5 * e.length * ge.x * e.direction;
    double inner = 0;
    for (const GaussPoint& gf : gauss_rule(nf)) {
      const Vec3 r = x + 0.5 * f.length * gf.x * f.direction;
      inner += gf.weight * std::log(glm::dot(r, r) / unit2);
    }
    sum += ge.weight * inner;
  }
  return 0.125 * e.length * f.length * sum;
}

/// Where, along the outer edge, the integrand is singular: at position + i height in the complex
/// plane.
struct Singularity {
  double position;
  double height;
};

/// The inner edge's integral as a function of the place on the outer edge, and its singularities.
class OuterIntegrand {
 public:
  OuterIntegrand(const Edge& outer, const Edge& inner, double unit2)
      : inner_length_(inner.length), inverse_unit2_(1 / unit2) {
    const Vec3 w = outer.start - inner.start;
    along0_ = glm::dot(w, inner.direction);
    along1_ = glm::dot(outer.direction, inner.direction);
    across0_ = glm::cross(w, inner.direction);
    across1_ = glm::cross(outer.direction, inner.direction);
    add(outer, inner.start);
    add(outer, inner.start + inner.length * inner.direction);
    // Closest approach of the two lines: the height h over the inner edge's line has a branch point
    // there, and the integrand sees it where the foot lies on the inner edge. Its strength is the
    // sine of the angle.
    const double sine2 = glm::dot(across1_, across1_);
    if (sine2 > kEpsilon * kEpsilon) {
      const double t = -glm::dot(across0_, across1_) / sine2;
      const double foot = along0_ + t * along1_;
      if (foot > 0 && foot < inner.length)
        singular_[count_++] = {t, std::abs(glm::dot(w, across1_)) / sine2};
    }
  }

  /// int over the inner edge of ln(r / unit) = sum of u ln r at its ends + h (angle it fills) -
  /// length.
  double operator()(double t) const {
    const double a = along0_ + t * along1_;
    const double b = inner_length_ - a;
    const Vec3 across = across0_ + t * across1_;
    const double h2 = glm::dot(across, across);
    const double a2 = a * a + h2;
    const double b2 = b * b + h2;
    const double logs = (a2 > 0 ? a * std::log(a2 * inverse_unit2_) : 0) +
                        (b2 > 0 ? b * std::log(b2 * inverse_unit2_) : 0);
    const double h = std::sqrt(h2);
    return 0.5 * logs + h * std::atan2(h * inner_length_, h2 - a * b) - inner_length_;
  }

  /// The singularity that hurts a rule on [low, high] most: smallest ellipse, and its place.
  double worst_ellipse(double low, double high, Singularity* worst) const {
    const double half = 0.5 * (high - low);
    const double middle = 0.5 * (low + high);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < count_; ++k) {
      const double x = (singular_[k].position - middle) / half;
      const double y2 = (singular_[k].height / half) * (singular_[k].height / half);
      const double axis =
          0.5 * (std::sqrt((x - 1) * (x - 1) + y2) + std::sqrt((x + 1) * (x + 1) + y2));
      if (axis < least) {
        least = axis;
        *worst = singular_[k];
      }
    }
    least = std::max(least, 1.0);
    return least + std::sqrt(least * least - 1);
  }

  /// Whether a singularity sits on `end`, to rounding, and all others are three widths away.
  bool touches_only_at(double end, double width) const {
    bool touches = false;
    for (std::size_t k = 0; k < count_; ++k) {
      const double away = std::hypot(singular_[k].position - end, singular_[k].height);
      if (away > kTouching * width && away < 3 * width) return false;
      touches = touches || away <= kTouching * width;
    }
    return touches;
  }

 private:
  void add(const Edge& outer, const Vec3& end) {
    const Vec3 w = end - outer.start;
    singular_[count_++] = {glm::dot(w, outer.direction),
                           glm::length(glm::cross(w, outer.direction))};
  }

  double inner_length_;
  double inverse_unit2_;
  double along0_;
  double along1_;
  Vec3 across0_;
  Vec3 across1_;
  std::array<Singularity, 3> singular_{};
  std::size_t count_ = 0;
};

double gauss(const OuterIntegrand& g, double low, double high, int n) {
  const double half = 0.5 * (high - low);
  const double middle = 0.5 * (low + high);
  double sum = 0;
  for (const GaussPoint& point : gauss_rule(n)) sum += point.weight * g(middle + half * point.x);
  return half * sum;
}

/// Towards an end where the edges touch, the integrand behaves like t ln t. With t = u^4 that is
/// u^7 ln u, which a Gauss rule integrates to rounding.
double touching(const OuterIntegrand& g, double end, double other) {
  double sum = 0;
  for (const GaussPoint& point : gauss_rule(kTouchingPoints)) {
    const double u = 0.5 * (1 + point.x);
    sum += point.weight * u * u * u * g(end + (other - end) * (u * u * u * u));
  }
  return 2 * std::abs(other - end) * sum;
}

/// Cuts [low, high] at singularities inside, and in a geometric row towards those at its ends,
/// until a rule fits.
double graded(const OuterIntegrand& g, double low, double high, double smallest) {
  Singularity worst{};
  const double width = high - low;
  const int n = points_needed(g.worst_ellipse(low, high, &worst));
  if (n <= kMaxPoints || width <= smallest) return gauss(g, low, high, std::min(n, kMaxPoints));
  if (g.touches_only_at(low, width)) return touching(g, low, high);
  if (g.touches_only_at(high, width)) return touching(g, high, low);
  double cut = worst.position;
  if (cut < low + 0.05 * width || cut > high - 0.05 * width) {
    const bool at_low = cut < low + 0.5 * width;
    const double away = std::hypot(at_low ? low - cut : cut - high, worst.height);
    const double share = std::clamp(0.2 + away / width, 0.2, 0.5) * width;
    cut = at_low ? low + share : high - share;
  }
  return graded(g, low, cut, smallest) + graded(g, cut, high, smallest);
}

}  // namespace

double log_distance_integral(const Edge& e, const Edge& f, double unit) {
  const double unit2 = unit * unit;
  const Vec3 w =
      (f.start + 0.5 * f.length * f.direction) - (e.start + 0.5 * e.length * e.direction);
  const double gap = glm::length(w) - 0.5 * (e.length + f.length);
  const bool parallel = glm::length(glm::cross(e.direction, f.direction)) <= 2 * kEpsilon;
  const double reach = glm::length(w) + 0.5 * (e.length + f.length);
  if (parallel && reach * reach <= kParallelLoss * e.length * f.length)
    return parallel_integral(e, f, glm::dot(e.direction, f.direction) > 0 ? 1 : -1, unit2);
  if (gap > 0) {
    const double over_e = 2 * gap / e.length;
    const double over_f = 2 * gap / f.length;
    const int ne = points_needed(over_e + std::sqrt(1 + over_e * over_e));
    const int nf = points_needed(over_f + std::sqrt(1 + over_f * over_f));
    const bool enough = ne <= kMaxPoints && nf <= kMaxPoints;
    if (enough && (parallel || ne * nf <= kMaxProduct))
      return product_integral(e, ne, f, nf, unit2);
  }
  // The shorter edge outside: the singularities of the longer one are then furthest for its length.
  const bool e_outside = e.length <= f.length;
  const Edge& outer = e_outside ? e : f;
  return graded(OuterIntegrand(outer, e_outside ? f : e, unit2), 0, outer.length,
                kSmallest * outer.length);
}

}  // namespace host
