#include "accuracy/known_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "accuracy/pair_families.hpp"

namespace host {

namespace {

/// A value as printed: its last digit says how well it is known.
struct Printed {
  const char* text;
  double value() const { return std::stod(text); }
  double tolerance() const {
    const std::string digits(text);
    return std::max(1e-12, std::pow(10.0, -double(digits.size() - digits.find('.') - 1)));
  }
};

KnownValue known(std::string name, Polygon p, Polygon q, Printed printed) {
  return {std::move(name), std::move(p), std::move(q), printed.value(), printed.tolerance(), {}};
}

void add_parallel(std::vector<KnownValue>* list) {
  const struct {
    double a, b, gap;
    Printed f;
  } cases[] = {{1, 1, 1, {"0.199824895698387"}},    {1, 1, 0.1, {"0.826994522397257"}},
               {1, 1, 0.01, {"0.980416602925973"}}, {1, 1, 10, {"0.00316205683876"}},
               {2, 1, 1, {"0.285875384850715"}},    {10, 0.1, 1, {"0.046708353330323"}},
               {2, 2, 1, {"0.415253283577147"}},    {0.2, 0.2, 1, {"0.012403977313243"}},
               {1, 10, 1, {"0.386382489"}},         {1, 100, 1, {"0.411420024"}},
               {1, 1000, 1, {"0.413934198"}}};
  for (const auto& c : cases)
    list->push_back(known(fmt::format("parallel {} x {}, gap {}", c.a, c.b, c.gap),
                          rectangle(c.a, c.b), flipped(rectangle(c.a, c.b, c.gap)), c.f));
  list->push_back(known("parallel unit squares, shifted (1, 0)", rectangle(1, 1),
                        flipped(rectangle(1, 1, 1, 1, 0)), {"0.0860504891523273"}));
  list->push_back(known("parallel unit squares, shifted (1, 1)", rectangle(1, 1),
                        flipped(rectangle(1, 1, 1, 1, 1)), {"0.0433274095741047"}));
}

void add_perpendicular(std::vector<KnownValue>* list) {
  const struct {
    double w, h, l;
    Printed f;
  } cases[] = {{1, 1, 1, {"0.200043776075403"}},
               {1, 2, 1, {"0.232852602795362"}},
               {0.1, 0.1, 1, {"0.281887806787901"}},
               {10, 10, 1, {"0.0550239795284106"}},
               {1, 0.01, 1, {"0.00489584926850668"}}};
  for (const auto& c : cases) {
    const PolygonPair pair = hinge(90, c.w, c.h, c.l);
    list->push_back(
        known(fmt::format("perpendicular w {} h {} l {}", c.w, c.h, c.l), pair.p, pair.q, c.f));
  }
  const struct {
    double away;
    Printed f;
  } apart[] = {
      {0.1, {"0.154206868494109"}}, {0.5, {"0.0683370210857383"}}, {1, {"0.0329381622582032"}}};
  for (const auto& c : apart) {
    const double a = c.away;
    const Polygon wall{{{0, 0, a}, {0, 1, a}, {0, 1, 1 + a}, {0, 0, 1 + a}}, {}};
    list->push_back(known(fmt::format("perpendicular unit squares, {} from the common line", a),
                          rectangle(1, 1, 0, a), wall, c.f));
  }
}

void add_hinged(std::vector<KnownValue>* list) {
  const struct {
    double degrees;
    Printed f;
  } cases[] = {{1, {"0.982997178574649"}},      {5, {"0.920261908111222"}},
               {30, {"0.619028323090803"}},     {45, {"0.483347695478878"}},
               {60, {"0.370905321150051"}},     {90, {"0.200043776075403"}},
               {120, {"0.0866150011182761"}},   {135, {"0.048309447801818"}},
               {150, {"0.0213453254126894"}},   {170, {"0.00236205667876908"}},
               {175, {"0.000590290917433052"}}, {179, {"2.36087831149832e-5"}}};
  for (const auto& c : cases) {
    const PolygonPair pair = hinge(c.degrees);
    list->push_back(
        known(fmt::format("hinged unit squares, {} degrees", c.degrees), pair.p, pair.q, c.f));
  }
}

void add_free(std::vector<KnownValue>* list) {
  for (const auto& [corners, f] :
       {std::pair{8, Printed{"0.363710714422825"}}, std::pair{64, Printed{"0.381691438558507"}}})
    list->push_back(known(fmt::format("regular {}-gons in unit circles, gap 1", corners),
                          regular_polygon(corners, 1, 0), flipped(regular_polygon(corners, 1, 1)),
                          f));

  const Polygon p{{{.1, .2, .1}, {.5, .1, .1}, {.6, .6, .1}, {.2, .5, .1}}, {}};
  const Polygon q{{{.3, .3, .4}, {.3, .9, .7}, {.9, .9, .8}, {.9, .3, .5}}, {}};
  list->push_back(known("free pair", p, q, {"0.184117237579462"}));
  list->push_back(known("free pair, back", q, p, {"0.0723909484548047"}));

  const Polygon arrow{{{0, 0, 0}, {1, 0, 0}, {.25, .25, 0}, {0, 1, 0}}, {}};
  const Polygon above = flipped(rectangle(1, 1, 0.5));
  list->push_back(known("concave arrow to a square", arrow, above, {"0.3637972350373"}));
  list->push_back(known("square to a concave arrow", above, arrow, {"0.0909493087593249"}));

  const Polygon top = flipped(rectangle(1, 1, 1)), plate = rectangle(0.5, 0.5, 0.5);
  list->push_back(known("top square to the plate below", top, plate, {"0.103813320894287"}));
  list->push_back(known("plate to the top square", plate, top, {"0.415253283577147"}));
}

/// Walls 1..6 along the plan, 7 the ceiling, 8 the floor.
std::vector<Polygon> l_room_faces() {
  const Loop plan{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  const Vec3 up(0, 0, 3);
  std::vector<Polygon> faces;
  Polygon ceiling;
  for (std::size_t k = 0; k < plan.size(); ++k) {
    const Vec3 a = plan[k], b = plan[(k + 1) % plan.size()];
    faces.push_back({{b, a, a + up, b + up}, {}});
    ceiling.outer.push_back(a + up);
  }
  faces.push_back(flipped(ceiling));
  faces.push_back({plan, {}});
  return faces;
}

struct LRoomFactor {
  int from, to;
  Printed f;
  bool open;  // nothing stands between the two
};

constexpr LRoomFactor kLRoom[] = {
    {1, 2, {"0.1131544"}, true},  {1, 3, {"0.3780929"}, true},  {1, 4, {"0.0274734"}, true},
    {1, 5, {"0.0328902"}, false}, {1, 6, {"0.1823559"}, false}, {1, 7, {"0.1330165"}, false},
    {1, 8, {"0.1330165"}, false}, {2, 1, {"0.3394632"}, true},  {2, 3, {"0.3189967"}, true},
    {2, 4, {"0.0000000"}, false}, {2, 5, {"0.0000000"}, false}, {2, 6, {"0.0986707"}, false},
    {2, 7, {"0.1214346"}, false}, {2, 8, {"0.1214346"}, false}, {3, 1, {"0.5671393"}, true},
    {3, 2, {"0.1594984"}, true},  {3, 6, {"0.0412101"}, true},  {3, 7, {"0.1160761"}, true},
    {3, 8, {"0.1160761"}, true},  {7, 1, {"0.2394298"}, false}, {7, 6, {"0.2394298"}, false},
    {7, 2, {"0.0728607"}, false}, {7, 5, {"0.0728607"}, false}, {7, 3, {"0.1392913"}, true},
    {7, 4, {"0.1392913"}, true},  {7, 8, {"0.0968364"}, false}};

KnownValue l_room_value(const LRoomFactor& factor, const std::vector<Polygon>& faces) {
  const auto face = [&](int number) { return faces[std::size_t(number - 1)]; };
  return known(fmt::format("L-room {} to {}", factor.from, factor.to), face(factor.from),
               face(factor.to), factor.f);
}

}  // namespace

std::vector<KnownValue> known_values() {
  std::vector<KnownValue> list;
  add_parallel(&list);
  add_perpendicular(&list);
  add_hinged(&list);
  add_free(&list);
  const std::vector<Polygon> faces = l_room_faces();
  for (const LRoomFactor& factor : kLRoom)
    if (factor.open) list.push_back(l_room_value(factor, faces));
  return list;
}

std::vector<KnownValue> known_square_obstructions() {
  std::vector<KnownValue> list;
  const auto add = [&](const char* name, double corner, Printed f) {
    const Polygon top{{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, {}};
    list.push_back(known(name, rectangle(1, 1), top, f));
    list.back().blockers = {rectangle(0.5, 0.5, 0.5, corner, corner)};
  };
  add("square obstruction in a corner", 0, {"0.149868671773791"});
  add("square obstruction in the middle", 0.25, {"0.0995062945989848"});
  return list;
}

std::vector<KnownValue> known_l_room() {
  const std::vector<Polygon> faces = l_room_faces();
  std::vector<KnownValue> list;
  for (const LRoomFactor& factor : kLRoom) {
    list.push_back(l_room_value(factor, faces));
    for (int k = 1; k <= int(faces.size()); ++k)
      if (k != factor.from && k != factor.to)
        list.back().blockers.push_back(faces[std::size_t(k - 1)]);
  }
  return list;
}

}  // namespace host
