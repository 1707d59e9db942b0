// Section 2.9: what a set of form factors costs, counted.
#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "form_factor/reference.hpp"
#include "legacy/centre_hemicube.hpp"
#include "legacy/reproduce.hpp"
#include "method/engine_source.hpp"
#include "report/text.hpp"
#include "scene/ray_scene.hpp"
#include "solve/exact.hpp"

namespace host {

namespace {

struct Operations {
  std::int64_t flops = 0;    ///< products and sums
  std::int64_t library = 0;  ///< calls of exp
  std::int64_t rays = 0;
};

/// A number that counts what is done with it.
struct Counted {
  double value;
  Operations* count;

  Counted operator*(const Counted& y) const {
    return ++count->flops, Counted{value * y.value, count};
  }
  Counted operator+(const Counted& y) const {
    return ++count->flops, Counted{value + y.value, count};
  }
  Counted sigmoid() const { return ++count->library, Counted{1 / (1 + std::exp(-value)), count}; }
};

Operations network_pair(const LegacyNet& net, const LegacyInput& input, double* f) {
  Operations count;
  const auto number = [&](float value) { return Counted{double(value), &count}; };
  Counted sum = number(net.output_bias);
  for (std::size_t h = 0; h < std::size_t(net.hidden); ++h) {
    Counted z = number(net.hidden_bias[h]);
    for (std::size_t n = 0; n < kLegacyInputs; ++n)
      z = z + number(net.hidden_weight[h * kLegacyInputs + n]) * number(input[n]);
    sum = sum + number(net.output_weight[h]) * z.sigmoid();
  }
  *f = legacy_unscaled(net.scaling, sum.sigmoid().value);
  return count;
}

template <class Run>
double seconds(Run&& run) {
  const Stopwatch time;
  run();
  return time.seconds();
}

std::string counts(std::int64_t flops, std::int64_t library, std::int64_t rays) {
  return fmt::format("{} rays, {} flops, {} library calls", metric(double(rays)),
                     metric(double(flops)), metric(double(library)));
}

}  // namespace

std::vector<ResultTable> reproduce_operations(const ReproduceRequest& request,
                                              const CubeExperiment& cube) {
  const Scene& scene = cube.scene;
  const auto n = std::int64_t(scene.patches.size());
  ResultTable table{
      "section2.9",
      "Section 2.9: operations for all form factors of the cube, and time on one core",
      {"method", "by the report's formula", "counted", "seconds"},
      {},
      {}};
  for (const int resolution : {8, 32, 64}) {
    HemicubeCount count;
    const double spent = seconds([&] { (void)centre_hemicube(scene, resolution, 1, &count); });
    const std::int64_t c = hemicube_cells(resolution);
    table.rows.push_back({fmt::format("hemicube, {} cells a side", resolution),
                          "n (c rays + c sums): " + counts(n * c, 0, n * c),
                          counts(std::int64_t(count.sums), 0, std::int64_t(count.rays)),
                          short_number(spent)});
  }
  std::vector<Blocker> polygons;
  for (const ScenePatch& patch : scene.patches) polygons.push_back({patch.polygon, patch.surface});
  const RayScene rays(polygons);
  for (const LegacyNetFile& file : cube.nets) {
    const LegacyNet& net = file.net;
    if (net.scaling != LegacyScaling::linear) continue;
    Operations all;
    for (std::size_t i = 0; i < scene.patches.size(); ++i) {
      for (std::size_t j = 0; j < scene.patches.size(); ++j) {
        const ScenePatch &a = scene.patches[i], &b = scene.patches[j];
        if (a.surface == b.surface || !can_face(a, b)) continue;
        double f = 0;
        const Operations pair = network_pair(net, legacy_input(a.polygon, b.polygon), &f);
        all.flops += pair.flops, all.library += pair.library, ++all.rays;
      }
    }
    const double spent = seconds([&] {
      (void)legacy_factors(scene, net, 1);
      for (const ScenePatch& a : scene.patches)
        for (const ScenePatch& b : scene.patches)
          if (a.surface != b.surface)
            (void)rays.blocked(a.moments.centroid, b.moments.centroid, a.surface, b.surface);
    });
    const std::int64_t h = net.hidden, pairs = n * n;
    table.rows.push_back({fmt::format("network {}", net.name()),
                          "n² (24·2 h + 2 h flops, h calls, 1 ray): " +
                              counts(pairs * (h * kLegacyInputs * 2 + h * 2), pairs * h, pairs),
                          counts(all.flops, all.library, all.rays), short_number(spent)});
  }
  const double analytic = seconds([&] {
    for (std::size_t i = 0; i < scene.patches.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (scene.patches[i].surface != scene.patches[j].surface)
          (void)reference_exchange(scene.patches[i].polygon, scene.patches[j].polygon);
  });
  table.rows.push_back(
      {"analytic (this project's reference)", "not given",
       fmt::format("{} contour integrals, one for both directions", metric(72030 / 2.0)),
       short_number(analytic)});
  table.notes = {
      "The report counts a sum a cell; cells of a row that show one patch are summed in one "
      "addition after a run-length count, and cells whose ray meets nothing lit cost none. It "
      "counts n² pairs where Figure 4.1 leaves out those that do not face each other, and forgets "
      "the sigmoid of the output unit: h + 1 calls. Time: double precision, plain loops, rays by "
      "Embree; seconds of the processor.",
      "With the sums of the first layer kept per patch (P_i + Q_j, as the engine does), the 24·2 h "
      "flops of a pair become h."};
  if (!request.shortened.empty()) table.notes.push_back(request.shortened);
  return {table};
}

}  // namespace host
