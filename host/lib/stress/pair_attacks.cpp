#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "form_factor/monte_carlo.hpp"
#include "form_factor/reference.hpp"
#include "geometry/parse.hpp"
#include "geometry/planar.hpp"
#include "method/pair_method.hpp"
#include "stress/attacks.hpp"
#include "stress/growing_blockers.hpp"
#include "stress/hostile_pairs.hpp"

namespace host {
namespace {

constexpr double kShown = std::numeric_limits<double>::infinity();  // measured, never a failure
constexpr double kLeastFactor = 1e-6;  // relative errors count from here on
constexpr double kLsb = 0x1p-32;       // of an engine's factor
constexpr double kRounding = 1e-14;    // of the smaller area: below it a double has no digits left
constexpr double kSplitRounding = 1e-11;  // the same for sums over cut polygons, slivers among them

/// A method and the bounds that it is held to; relative, but for factors of the engine, whose last
/// bit is free.
struct Method {
  std::string name;
  double reciprocal;
  bool integer;
  FreePairMethod run;
};

std::vector<Method> methods(const NetChoice& nets) {
  const struct {
    const char* name;
    double reciprocal;
    bool integer;
  } bounds[] = {
      {"reference", 1e-9, false},    {"kernel", 1e-9, false},      {"moment", 1e-9, false},
      {"lambert:2", kShown, false},  {"gauss:2", 1e-9, false},     {"monte-carlo:256", 1e-9, false},
      {"fixed-kernel", 1e-5, true},  {"fixed-moment", 1e-5, true}, {"fixed-lambert:2", 1e-5, true},
      {"net", 1e-5, true},           {"closed-form", 1e-9, false}, {"auto", 1e-5, true},
      {"hemicube:32", kShown, true},
  };
  std::vector<Method> all;
  for (const auto& b : bounds)
    all.push_back({b.name, b.reciprocal, b.integer, pair_method(parse_method(b.name), nets)});
  return all;
}

/// |a - b| over the larger, less what the last bit of both explains.
double relative(double a, double b, double free) {
  const double off = std::max(0.0, std::abs(a - b) - free);
  return off > 0 ? off / std::max(a, b) : 0;
}

/// Every loop written from another vertex, holes the other way round.
Polygon rewritten(Polygon polygon) {
  std::rotate(polygon.outer.begin(), polygon.outer.begin() + 1, polygon.outer.end());
  for (Loop& hole : polygon.holes) {
    std::reverse(hole.begin(), hole.end());
    std::rotate(hole.begin(), hole.begin() + 1, hole.end());
  }
  std::reverse(polygon.holes.begin(), polygon.holes.end());
  return polygon;
}

/// The factor, or nothing where the method says that it cannot.
std::optional<Estimate> factor(const Method& method, const Polygon& p, const Polygon& q,
                               Findings* findings) {
  const PairResult result = method.run.run(p, q);
  const std::string what = method.name + ": ";
  if (result.status != "ok") {
    findings->expect(what + "a factor, or unsupported",
                     result.status.rfind("unsupported_", 0) == 0);
    return std::nullopt;
  }
  const double f = result.estimate.f;
  findings->expect(what + "finite, 0 to 1", f >= 0 && f <= 1);
  return result.estimate;
}

/// Relative errors of factors that matter; `auto` has to say so itself where one is beyond 10 %.
void check_error(const std::string& name, const Estimate& estimate, double exact,
                 Findings* findings) {
  const double error = std::abs(estimate.f / exact - 1);
  findings->measure(name + ": relative error, F > 1e-6", error);
  if (name != "auto") return;
  findings->measure("auto: error beyond 10 % and 3 times what it says",
                    std::max(0.0, error - std::max(0.1, 3 * estimate.relative_error)), 0);
}

void check_method(const Method& method, const PolygonPair& pair, double exact, double area_p,
                  double area_q, Findings* findings) {
  const std::optional<Estimate> there = factor(method, pair.p, pair.q, findings);
  const std::optional<Estimate> back = factor(method, pair.q, pair.p, findings);
  const std::optional<Estimate> again =
      factor(method, rewritten(pair.p), rewritten(pair.q), findings);
  if (!there || !back || !again) return;
  const double bit = method.integer ? kLsb : 0;
  const double free = bit * (area_p + area_q) + kRounding * std::min(area_p, area_q);
  findings->measure(method.name + ": reciprocal",
                    relative(there->f * area_p, back->f * area_q, free), method.reciprocal);
  findings->expect(method.name + ": the same from any vertex", there->f == again->f);
  if (exact > kLeastFactor) check_error(method.name, *there, exact, findings);
}

/// Standard errors between reference and sampling. Few samples have a scatter that is itself
/// uncertain: what looks bad is sampled again, ever closer. One sample more is always possible that
/// sees all of the other patch.
double deviation(const PolygonPair& pair, const Estimate& exact) {
  const double area_p = moments(pair.p).area, area_q = moments(pair.q).area;
  double off = 0;
  for (const std::int64_t samples : {1 << 8, 1 << 14, 1 << 20}) {
    const Estimate e = monte_carlo(pair.p, pair.q, samples, {}, std::uint64_t(samples));
    const double one = std::min(1.0, area_q / area_p) / double(samples);
    const double error = std::max(one, e.relative_error > 0 ? e.relative_error * e.f : 0);
    const double claimed = exact.relative_error * std::max(exact.f, e.f);
    off = std::max(0.0, std::abs(e.f - exact.f) - claimed) / (error + 1e-6 * exact.f);
    if (off < 5) break;
  }
  return off;
}

/// How far corners are from the plane of their polygon, or may be by the rounding of coordinates.
double unevenness(const Polygon& polygon) {
  const Moments m = moments(polygon);
  double most = coordinate_rounding(polygon);
  for (const Vec3& x : polygon.outer)
    most = std::max(most, std::abs(glm::dot(m.normal, x - m.centroid)));
  return most;
}

/// What uneven corners leave undetermined of the height of `other` over the plane of `polygon`,
/// relative: the corner itself, and its lever over the polygon's width.
double loose(const Polygon& polygon, const Polygon& other) {
  const Moments m = moments(polygon);
  const Vec3 r = moments(other).centroid - m.centroid;
  const double trace = m.second[0][0] + m.second[1][1] + m.second[2][2];
  const double width = m.area / std::sqrt(12 * trace);
  const double uneven = std::max(unevenness(polygon), unevenness(other));
  return uneven * (1 + glm::length(r) / width) / std::abs(glm::dot(m.normal, r));
}

/// The same for a method that promises no more than its accuracy: shown where the pair matters.
void show_split(const Method& method, const std::vector<Polygon>& parts, const Polygon& q,
                double whole, double area, Findings* findings) {
  double sum = 0;
  for (const Polygon& part : parts) {
    const PairResult result = method.run.run(part, q);
    if (result.status != "ok") return;
    sum += result.estimate.f * moments(part).area;
  }
  findings->measure(method.name + ": sum of a split patch, F > 1e-6",
                    std::abs(sum / (whole * area) - 1));
}

/// The pair moved to the origin where no coordinate is rounded by that, as far away it is not; else as
/// it is. Corners of a cut are then rounded to the size of the pair, not to its distance.
PolygonPair near_origin(const PolygonPair& pair) {
  const Vec3 origin = pair.p.outer.front();
  PolygonPair moved = pair;
  bool exact = true;
  const auto move = [&](Loop& loop) {
    for (Vec3& x : loop) {
      const Vec3 to = x - origin;
      exact = exact && to + origin == x;
      x = to;
    }
  };
  for (Polygon* polygon : {&moved.p, &moved.q}) {
    move(polygon->outer);
    for (Loop& hole : polygon->holes) move(hole);
  }
  return exact ? moved : pair;
}

/// The cut of p by a plane through its centroid, across its longest reach.
void check_split(const PolygonPair& pair, const Estimate& exact, double area,
                 const std::vector<Method>& methods, Findings* findings) {
  const Moments m = moments(pair.p);
  Vec3 reach(0);
  for (const Vec3& x : pair.p.outer)
    if (glm::length(x - m.centroid) > glm::length(reach)) reach = x - m.centroid;
  const Vec3 across = glm::normalize(reach);
  const double area_q = moments(pair.q).area;
  const double smaller = std::min(area, area_q);
  // A cut rounds new corners, and with them the planes.
  const auto tilt = [&](const Polygon& p) { return 16 * (loose(p, pair.q) + loose(pair.q, p)); };
  double sum = 0, back = 0;
  double claimed =
      kSplitRounding * smaller + exact.f * (exact.relative_error + tilt(pair.p)) * area;
  std::vector<Polygon> parts;
  for (const Vec3& normal : {across, -across}) {
    const Polygon part = clip(pair.p, m.centroid, normal);
    if (!part.outer.empty()) parts.push_back(part);
  }
  for (const Polygon& part : parts) {
    const Estimate there = reference_estimate(part, pair.q);
    sum += there.f * moments(part).area;
    back += reference_form_factor(pair.q, part) * area_q;
    claimed += there.f * (there.relative_error + tilt(part)) * moments(part).area;
  }
  findings->measure("reference: area-weighted sum of a split patch",
                    relative(sum, exact.f * area, claimed), 1e-8);
  findings->measure("reference: sum over a split receiver", relative(back, exact.f * area, claimed),
                    1e-8);
  for (const Method& method : methods) {
    const PairResult whole = method.run.run(pair.p, pair.q);
    if (method.name != "reference" && whole.status == "ok" && whole.estimate.f > kLeastFactor)
      show_split(method, parts, pair.q, whole.estimate.f, area, findings);
  }
}

class PairCheck {
 public:
  explicit PairCheck(const NetChoice& nets) : nets_(nets), methods_(methods(nets_)) {}

  void run(const std::string& input, Findings* findings) const {
    const std::size_t end = input.find('\n');
    PolygonPair pair;
    if (end == input.npos || !read_polygon(input.substr(0, end), &pair.p) ||
        !read_polygon(input.substr(end + 1), &pair.q))
      throw Error("a case of pairs is two polygons in two lines");
    const bool valid = validate(pair.p, pair.q) == PolygonStatus::ok;
    if (!valid) return survive(pair, findings);
    const double area_p = moments(pair.p).area, area_q = moments(pair.q).area;
    const Estimate exact = reference_estimate(pair.p, pair.q);
    for (const Method& method : methods_)
      check_method(method, pair, exact.f, area_p, area_q, findings);
    findings->measure("reference: standard errors from sampling", deviation(pair, exact), 8);
    findings->measure("reference: relative error it claims", exact.relative_error);
    const PolygonPair local = near_origin(pair);
    check_split(local, reference_estimate(local.p, local.q), moments(local.p).area, methods_,
                findings);
    if (exact.f > 0) check_growing_blockers(pair, nets_, findings);
  }

 private:
  /// What the command refuses the library still has to live through.
  void survive(const PolygonPair& pair, Findings* findings) const {
    for (const Method& method : methods_)
      for (const bool turned : {false, true})
        factor(method, turned ? pair.q : pair.p, turned ? pair.p : pair.q, findings);
    findings->measure("refused by the command", 1);
  }

  NetChoice nets_;
  std::vector<Method> methods_;
};

}  // namespace

std::vector<Attack> pair_attacks(const NetChoice& nets) {
  const auto check = std::make_shared<PairCheck>(nets);
  std::vector<Attack> attacks;
  for (const HostileFamily& family : hostile_families())
    attacks.push_back(
        {"pairs", family.name,
         [draw = family.draw](Random& random) {
           const PolygonPair pair = draw(random);
           return write_polygon(pair.p) + "\n" + write_polygon(pair.q);
         },
         [check](const std::string& input, Findings* findings) { check->run(input, findings); }});
  return attacks;
}

}  // namespace host
