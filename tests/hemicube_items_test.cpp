// The item buffer against rays in double, and bands against whole faces, on random sets of
// polygons.
#include <doctest/doctest.h>

#include <array>
#include <memory>
#include <random>

#include "polygon_scene.hpp"
#include "urad/patch.hpp"
#include "urad/vec.hpp"

namespace {

using test::Hemicube, test::PolygonScene, test::Tables, test::to_vec, test::Vec;

/// The ray of a cell, in scene axes. Faces as hemicube_items() lists them.
Vec ray_of(const urad::HemicubeFrame& frame, int face, int column, int row, int resolution) {
  const double s = (2.0 * column + 1 - resolution) / resolution,
               t = (2.0 * row + 1 - resolution) / resolution;
  const Vec x = to_vec(frame.axis[0]), y = to_vec(frame.axis[1]), z = to_vec(frame.axis[2]);
  switch (face) {
    case 0:
      return glm::normalize(s * x + t * y + z);
    case 1:
      return glm::normalize(s * y + t * z + x);
    case 2:
      return glm::normalize(-s * y + t * z - x);
    case 3:
      return glm::normalize(-s * x + t * z + y);
    default:
      return glm::normalize(s * x + t * z - y);
  }
}

double distance_to_segment(const Vec& p, const Vec& a, const Vec& b) {
  const Vec ab = b - a;
  const double length2 = glm::dot(ab, ab);
  const double along = length2 > 0 ? std::clamp(glm::dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
  return glm::length(p - a - along * ab);
}

struct Hit {
  uint16_t item = urad::kNoItem;
  bool doubtful = false;  ///< within rounding of an edge, or of another polygon in front of it
};

struct Solid {
  std::vector<Vec> loop;
  Vec normal;
  uint16_t item;
};

/// Nearest polygon along a ray by even-odd in the polygon's plane.
Hit trace(const std::vector<Solid>& solids, const Vec& eye, const Vec& ray) {
  struct Found {
    double distance;
    double slack;
    uint16_t item;
  };
  std::vector<Found> found;
  Hit hit;
  for (const Solid& solid : solids) {
    const double offset = glm::dot(solid.normal, solid.loop[0] - eye),
                 cosine = glm::dot(solid.normal, ray);
    // Within the tolerance the eye lies in the plane, and sees it edge-on.
    if (std::fabs(offset) < urad::kPlaneTolerance + 2) {
      if (std::fabs(offset) > urad::kPlaneTolerance - 2) hit.doubtful = true;
      continue;
    }
    const double distance = offset / cosine;
    if (!(distance > 0)) continue;
    const Vec at = eye + distance * ray;
    const double slack = (8 + distance * 0x1p-26) / std::fabs(cosine);
    const int drop = std::fabs(solid.normal.x) > std::fabs(solid.normal.y)
                         ? (std::fabs(solid.normal.x) > std::fabs(solid.normal.z) ? 0 : 2)
                         : (std::fabs(solid.normal.y) > std::fabs(solid.normal.z) ? 1 : 2);
    const int u = (drop + 1) % 3, v = (drop + 2) % 3;
    bool inside = false, edge = false;
    for (size_t k = 0; k < solid.loop.size(); ++k) {
      const Vec &a = solid.loop[k], &b = solid.loop[(k + 1) % solid.loop.size()];
      if (distance_to_segment(at, a, b) <= slack) edge = true;
      if ((a[v] > at[v]) != (b[v] > at[v])) {
        if (a[u] + (at[v] - a[v]) / (b[v] - a[v]) * (b[u] - a[u]) > at[u]) inside = !inside;
      }
    }
    if (inside || edge)
      found.push_back({distance, edge ? 1e300 : slack + distance * 1e-6, solid.item});
  }
  const Found* nearest = nullptr;
  for (const Found& f : found) {
    if (f.slack < 1e300 && (!nearest || f.distance < nearest->distance)) nearest = &f;
  }
  for (const Found& f : found) {
    if (&f == nearest) continue;
    const bool in_front = !nearest || f.distance < nearest->distance + nearest->slack +
                                                       std::min(f.slack, f.distance * 1e-3);
    if (in_front) hit.doubtful = true;
  }
  if (nearest) hit.item = nearest->item;
  return hit;
}

/// Star-shaped about its centre, so planar and simple, often concave.
std::vector<Vec> random_polygon(std::mt19937_64& random, const Vec& centre, double size) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> normal;
  const Vec n = glm::normalize(Vec{normal(random), normal(random), normal(random)});
  const Vec u = glm::normalize(glm::cross(n, std::fabs(n.x) < 0.7 ? Vec{1, 0, 0} : Vec{0, 1, 0}));
  const Vec v = glm::cross(n, u);
  const int count = 3 + int(random() % 7);
  std::vector<Vec> loop;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * M_PI * (k + 0.8 * unit(random)) / count,
                 radius = size * (0.15 + 0.85 * unit(random));
    loop.push_back(centre + radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return loop;
}

TEST_CASE(
    "the item of a cell is what a ray through its centre hits, except within rounding of an edge") {
  const uint64_t seed = 19960731;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  MESSAGE("seed ", seed);
  const std::array<int, 4> resolutions = {16, 34, 64, 128};
  std::vector<std::unique_ptr<Tables>> tables;
  tables.reserve(resolutions.size());
  for (const int r : resolutions) tables.push_back(std::make_unique<Tables>(r));
  long cells = 0, doubtful = 0, wrong = 0, hits = 0;
  for (int set = 0; set < 1000; ++set) {
    const size_t choice = set % 20 == 0 ? 3 : set % 5 == 0 ? 2 : size_t(set) % 2;
    const int resolution = resolutions[choice];
    // A tenth of the sets lie in a corner of the scene, ten thousand times smaller.
    const double size = set % 10 == 3 ? 5e4 : 4e8;
    const Vec middle = set % 10 == 3 ? Vec{4e8, -3e8, 2e8} : Vec{0};
    const auto point = [&] {
      return middle + size * Vec{unit(random), unit(random), unit(random)};
    };
    PolygonScene scene(0);
    std::vector<std::vector<Vec>> loops = {
        random_polygon(random, middle + 0.3 * (point() - middle), 0.1 * size)};
    scene.add(loops[0]);
    const int count = 1 + int(random() % 12);
    for (int k = 0; k < count; ++k) {
      const double radius =
          size * (k % 3 ? 0.1 + 0.3 * std::fabs(unit(random)) : 0.7 + 0.2 * unit(random));
      loops.push_back(random_polygon(random, middle + 0.4 * (point() - middle), radius));
      k % 5 == 4 ? scene.add_blocker(loops.back()) : scene.add(loops.back());
    }
    const urad_scene& pod = scene.pod();
    const urad::Patch shooter = urad::patch_at(pod, 0);
    const Vec eye = to_vec(shooter.centroid);
    std::vector<Solid> solids;
    for (uint16_t k = 1; k < pod.patch_count; ++k) {
      const urad::Patch patch = urad::patch_at(pod, k);
      Solid solid{{}, to_vec(patch.shape->normal_q30) * 0x1p-30, k};
      for (uint16_t v = 0; v < patch.vertex_count; ++v)
        solid.loop.push_back(to_vec(urad::patch_vertex(pod, patch, v)));
      if (glm::dot(solid.normal, solid.loop[0] - eye) > 0) solid.item = urad::kNoItem;
      solids.push_back(solid);
    }
    for (int b = 0; b < pod.blocker_count; ++b) {
      Solid solid{{}, to_vec(pod.blocker[b].normal_q30) * 0x1p-30, urad::kNoItem};
      for (uint32_t v = 0; v < pod.blocker[b].vertex_count; ++v)
        solid.loop.push_back(to_vec(pod.vertex[pod.blocker[b].first_vertex + v]));
      solids.push_back(solid);
    }

    const bool turned = set & 1;
    const uint8_t flags = uint8_t(urad::hemicube_coverage | (turned ? urad::hemicube_turned : 0));
    const urad::HemicubeFrame frame = urad::hemicube_frame(shooter.shape->normal_q30, 0, turned);
    Hemicube whole(pod, *tables[choice], uint16_t(resolution), flags);
    for (int face = 0; face < 5; ++face) {
      REQUIRE(urad::hemicube_items(&whole.source, 0, face, 0) == urad::Status::ok);
      for (int row = face ? resolution / 2 : 0; row < resolution; ++row) {
        for (int column = 0; column < resolution; ++column) {
          const Hit hit = trace(solids, eye, ray_of(frame, face, column, row, resolution));
          const uint16_t item = whole.source.item[row * resolution + column];
          ++cells;
          hits += item != urad::kNoItem;
          if (hit.doubtful) {
            ++doubtful;
          } else if (item != hit.item) {
            if (++wrong < 20)
              MESSAGE("set ", set, " R ", resolution, " face ", face, " row ", row, " column ",
                      column, " item ", item, " ray ", hit.item);
          }
        }
      }
    }
    whole.counters = {};
    const std::vector<uint32_t> row = whole.row(0);
    const std::vector<uint32_t> coverage(whole.source.coverage_uq32,
                                         whole.source.coverage_uq32 + pod.patch_count);
    for (const int rows : {1, 7, resolution / 2}) {
      Hemicube banded(pod, *tables[choice], uint16_t(rows), flags);
      CHECK(banded.row(0) == row);
      CHECK(std::equal(coverage.begin(), coverage.end(), banded.source.coverage_uq32));
      CHECK(banded.counters.cells == whole.counters.cells);
    }
    for (size_t k = 0; k < row.size(); ++k) CHECK(row[k] <= coverage[k]);
  }
  MESSAGE(cells, " cells, ", hits, " with an item, ", doubtful, " within rounding of an edge");
  CHECK(wrong == 0);
  CHECK(doubtful < cells / 1000);
  CHECK(hits > cells / 20);
}

}  // namespace
