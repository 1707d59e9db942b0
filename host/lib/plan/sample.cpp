#include "plan/sample.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "form_factor/reference.hpp"
#include "pose/pose_layout.hpp"
#include "solve/embree_visibility.hpp"
#include "solve/exact.hpp"
#include "urad/patch.hpp"

namespace host {

namespace {

constexpr double kSampledPairs = 20'000;    // of each set of rows, convex
constexpr double kSampledRays = 1'500'000;  // of each set of rows, occluded
constexpr std::size_t kFewestRows = 6, kMostRows = 64, kMoreRows = 2;
constexpr double kCountedPairs = 15'000;  // by each method, occluded, with few rays
constexpr int kCountedRays = 4;
constexpr double kComparedPairs = 200'000;  // of two exports, without a ray
constexpr int kRays = 512;  // pairs of points a pair, for the reference's visibility

std::size_t rows_for(const Scene& scene) {
  const double n = double(scene.patches.size());
  const double most = scene.convex ? kSampledPairs / n : kSampledRays / (n * kRays);
  return std::clamp(std::size_t(most), kFewestRows, kMostRows);
}

/// `count` of `items`, evenly.
template <class T>
std::vector<std::size_t> evenly(const std::vector<T>& items, std::size_t count) {
  std::vector<std::size_t> chosen;
  count = std::min(count, items.size());
  for (std::size_t k = 0; k < count; ++k)
    chosen.push_back(std::size_t(items[(2 * k + 1) * items.size() / (2 * count)]));
  return chosen;
}

Eigen::MatrixXd reference_rows(const Scene& scene, const std::vector<std::size_t>& rows, int rays,
                               int threads) {
  const EmbreeVisibility visibility(scene, rays);
  const std::size_t n = scene.patches.size();
  Eigen::MatrixXd f = Eigen::MatrixXd::Zero(Eigen::Index(rows.size()), Eigen::Index(n));
  parallel_for(rows.size() * n, threads, [&](std::size_t at) {
    const std::size_t i = rows[at / n], j = at % n;
    const ScenePatch &p = scene.patches[i], &q = scene.patches[j];
    if (i == j || (p.surface == q.surface && scene.surfaces[std::size_t(p.surface)].planar) ||
        !can_face(p, q))
      return;
    const double seen = scene.convex ? 1 : visibility.fraction(i, j);
    if (seen > 0)
      f(Eigen::Index(at / n), Eigen::Index(j)) =
          seen * reference_exchange(p.polygon, q.polygon) / p.moments.area;
  });
  return f;
}

double reflectance(const Scene& scene, std::size_t patch) {
  const Vec3& rho = scene.material_of(patch).reflectance;
  return (rho.x + rho.y + rho.z) / 3;
}

/// The engine's row, in a closed scene brought to the sum of a better one.
Eigen::RowVectorXd engine_row(const Scene& scene, const EngineSource& source, std::size_t patch,
                              const Eigen::RowVectorXd* better) {
  std::vector<std::uint32_t> f_uq32(scene.patches.size());
  source.row(std::uint16_t(patch), f_uq32.data());
  Eigen::RowVectorXd row(Eigen::Index(f_uq32.size()));
  for (std::size_t j = 0; j < f_uq32.size(); ++j) row[Eigen::Index(j)] = f_uq32[j] * 0x1p-32;
  if (scene.closed && better && row.sum() > 0) row *= better->sum() / row.sum();
  return row;
}

}  // namespace

Sample::Sample(const Scene& scene, const FixedScene& fixed, const Rehearsal& rehearsal, int threads)
    : scene_(scene), fixed_(fixed), light_(rehearsal.light) {
  const std::size_t rows = rows_for(scene);
  shooters_ = evenly(rehearsal.shooters, rows);
  const double most_counted = kCountedPairs / double(scene.patches.size());
  more_shooters_ =
      evenly(rehearsal.shooters,
             scene.convex ? kMoreRows * rows : std::max(std::size_t(most_counted), rows));
  for (std::size_t k = 0; k < scene.patches.size(); ++k)
    if (reflectance(scene, k) > 0) reflecting_.push_back(k);
  receivers_ = evenly(reflecting_, rows);
  std::vector<double> shots(scene.patches.size(), 0);
  for (const std::uint16_t shooter : rehearsal.shooters)
    shots[shooter] += 1 / double(rehearsal.shooters.size());
  for (const std::size_t k : shooters_) chance_.push_back(shots[k]);
  from_receivers_ = reference_rows(scene, receivers_, kRays, threads);
  from_shooters_ = reference_rows(scene, shooters_, kRays, threads);
}

double Sample::gathered_error(const EngineSource& source) const {
  const Eigen::Map<const Eigen::VectorXd> light(light_.data(), Eigen::Index(light_.size()));
  double off = 0, all = 0;
  for (std::size_t k = 0; k < receivers_.size(); ++k) {
    const Eigen::RowVectorXd reference = from_receivers_.row(Eigen::Index(k));
    const double rho = reflectance(scene_, receivers_[k]);
    const double wrong =
        rho * (engine_row(scene_, source, receivers_[k], &reference) - reference).dot(light);
    const double right = rho * reference.dot(light);
    off += wrong * wrong;
    all += right * right;
  }
  return all > 0 ? std::sqrt(off / all) : 0;
}

double Sample::coarser_error(const NetChoice& nets, const FixedScene& coarse,
                             const FixedScene& fine) const {
  const Eigen::Map<const Eigen::VectorXd> light(light_.data(), Eigen::Index(light_.size()));
  const MethodSpec net = parse_method("net");
  const EngineSource from_coarse(coarse, net, nets, {}), from_fine(fine, net, nets, {});
  const auto count = std::size_t(kComparedPairs / double(scene_.patches.size()));
  double off = 0, all = 0;
  for (const std::size_t k : evenly(reflecting_, std::max(count, kFewestRows))) {
    const Eigen::RowVectorXd right = engine_row(scene_, from_fine, k, nullptr);
    const Eigen::RowVectorXd wrong = engine_row(scene_, from_coarse, k, &right) - right;
    off += std::pow(reflectance(scene_, k) * wrong.dot(light), 2);
    all += std::pow(reflectance(scene_, k) * right.dot(light), 2);
  }
  return all > 0 ? std::sqrt(off / all) : 0;
}

double Sample::shot_error(const EngineSource& source) const {
  double off = 0, all = 0;
  for (std::size_t j = 0; j < light_.size(); ++j) {
    const Material& material = scene_.material_of(j);
    const double emitted = (material.exitance.x + material.exitance.y + material.exitance.z) / 3 /
                           fixed_.exitance_unit();
    if (reflectance(scene_, j) > 0) all += std::pow(std::max(0.0, light_[j] - emitted), 2);
  }
  for (std::size_t k = 0; k < shooters_.size(); ++k) {
    const std::size_t i = shooters_[k];
    const Eigen::RowVectorXd reference = from_shooters_.row(Eigen::Index(k));
    const Eigen::RowVectorXd wrong = engine_row(scene_, source, i, &reference) - reference;
    double squares = 0;
    for (std::size_t j = 0; j < light_.size(); ++j) {
      const double area = scene_.patches[i].moments.area / scene_.patches[j].moments.area;
      squares += std::pow(reflectance(scene_, j) * area * wrong[Eigen::Index(j)] * light_[i], 2);
    }
    off += squares / (double(shooters_.size()) * chance_[k]);
  }
  return all > 0 ? std::sqrt(off / all) : 0;
}

SampledMethod Sample::run(const MethodSpec& spec, const NetChoice& nets,
                          const EngineOptions& options, const RowSetting& setting,
                          const FixedScene* exported) const {
  const FixedScene& fixed = exported ? *exported : fixed_;
  SampledMethod result;
  EngineOptions counted = options;
  if (!scene_.convex) counted.rays = std::min(options.rays, kCountedRays);
  const EngineSource counting(fixed, spec, nets, counted);
  const bool few_but_dear = spec.name == "net" || spec.name == "hybrid";
  const auto& shooters = few_but_dear || !scene_.convex ? more_shooters_ : shooters_;
  std::vector<std::uint32_t> row(scene_.patches.size());
  for (const std::size_t k : shooters) counting.row(std::uint16_t(k), row.data());
  result.work = row_work(counting.counters(), fixed.pod(), setting, double(shooters.size()));
  const double rays = double(options.rays) / counted.rays;
  for (const WorkTerm term : {WorkTerm::rays, WorkTerm::lit, WorkTerm::ray_tests, WorkTerm::spared})
    result.work[std::size_t(term)] *= rays;
  const EngineSource source(fixed, spec, nets, options);
  const bool row_is_a_cube = spec.name == "hemicube" || spec.name == "hybrid";
  result.error = row_is_a_cube ? shot_error(source) : gathered_error(source);
  return result;
}

RowWork Sample::table_work(const std::vector<std::uint16_t>& block_of) const {
  const urad_scene& pod = fixed_.pod();
  RowWork sum{};
  for (const std::size_t k : shooters_) {
    urad_counters counters{};
    RowSetting setting;
    const std::size_t from = urad::surface_of(pod, std::uint16_t(k));
    for (std::size_t s = 0; s < pod.surface_count; ++s) {
      const urad_surface& to = pod.surface[s];
      const bool loads = block_of[from * pod.surface_count + s] != URAD_POSE_NO_BLOCK;
      (loads       ? counters.evaluated
       : s == from ? counters.skipped_same
                   : counters.skipped_facing) += to.patch_count;
      if (loads) setting.grid_rows += to.grid ? to.grid->count_v : 1;
    }
    const RowWork work = row_work(counters, pod, setting);
    for (std::size_t t = 0; t < kWorkTerms; ++t) sum[t] += work[t] / double(shooters_.size());
  }
  return sum;
}

}  // namespace host
