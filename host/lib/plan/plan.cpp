#include "plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "plan/chip_bytes.hpp"
#include "plan/constants.hpp"
#include "plan/sample.hpp"
#include "pose/pose_layout.hpp"
#include "report/text.hpp"
#include "scene/c_export.hpp"
#include "solve/exported_visibility.hpp"
#include "urad/form_factor.hpp"

namespace host {

namespace {

constexpr int kSightRays = 1024;         // of a pair, as `urad bake --visibility` makes them
constexpr int kInputs = 14, kBits = 16;  // of the networks that `urad train` makes

template <class Table>
const auto& find(const Table& table, std::string_view family) {
  const auto at = std::find_if(table.begin(), table.end(),
                               [&](const auto& entry) { return entry.family == family; });
  if (at == table.end()) throw Error(fmt::format("plan: no constants for {}", family));
  return *at;
}

class Planner {
 public:
  Planner(const Scene& scene, const NetChoice& nets, const PlanRequest& request)
      : scene_(scene),
        nets_(nets),
        request_(request),
        fixed_(scene),
        pod_(fixed_.pod()),
        rehearsal_(rehearse(fixed_, request.error)),
        sample_(scene, fixed_, rehearsal_, request.threads) {
    if (rehearsal_.shooters.empty())
      throw Error(scene.name +
                  ": nothing in this scene emits light, so that nothing is to be planned");
    plan_.scene = scene.name;
    plan_.patches = scene.patches.size();
    plan_.shots = rehearsal_.shots;
    plan_.shots_complete = rehearsal_.complete;
    plan_.request = request;
  }

  Plan make() {
    add_pairs("fixed-moment", "moment", "pairs", 0, 0);
    const urad_net& general = nets_.find("");
    const SampledMethod by_general =
        add_pairs("net", "net", "pairs", general.hidden,
                  net_flash(general.inputs, general.hidden, general.weight_bits));
    add_pairs("fixed-lambert:1", "lambert1", "pairs", 0, 0);
    const SampledMethod by_more = add_pairs("fixed-lambert:2", "lambert2", "pairs", 0, 0);
    for (const int hidden : {4, 8}) add_scene_net(by_general, by_more, general.hidden, hidden);
    if (request_.visibility && !scene_.convex) add_exported();
    add_table();
    for (const int resolution : {32, 64}) {
      add_hemicube(resolution, false);
      add_hemicube(resolution, true);
    }
    judge();
    return std::move(plan_);
  }

 private:
  /// Adds what all methods share to a line that has its own memory, work and error.
  void add(PlannedMethod method, std::string_view family, std::string_view code,
           const RowWork& work, double sampled_error, double more = 0,
           const FixedScene* exported = nullptr) {
    const MethodError& error = find(kMethodErrors, family);
    const double of_factors = std::hypot(error.factor * sampled_error, error.constant);
    const double per_row = find(kRowCosts, family).of(work) + more;
    const double per_shot = kSolverCost.of_shot(pod_.surface_count, pod_.patch_count,
                                                rehearsal_.updates / rehearsal_.shots);
    method.ram += solver_ram(pod_);
    method.data +=
        scene_flash_bytes(exported ? exported->pod() : pod_,
                          scene_.closed && code != "table" && family.find("hemicube") != 0);
    method.code = find(kMethodCode, code).bytes;
    method.per_shot = per_row + per_shot;
    method.per_solve = method.per_shot * rehearsal_.shots + kSolverCost.init +
                       kSolverCost.init_patch * pod_.patch_count;
    method.error = std::hypot(of_factors, kStopShare * request_.error);
    plan_.methods.push_back(std::move(method));
  }

  SampledMethod add_pairs(const std::string& name, std::string_view family, std::string_view code,
                          int hidden, std::size_t flash) {
    RowSetting setting;
    setting.hidden = hidden;
    const SampledMethod sampled = sample_.run(parse_method(name), nets_, {}, setting);
    PlannedMethod method;
    method.method = name;
    method.ram = kPairSourceBytes;
    method.data = flash;
    add(method, family, code, sampled.work, sampled.error);
    return sampled;
  }

  /// Not trained yet: as dear as the general network with fewer neurons, as accurate as such
  /// networks came out; rays leave it what they leave the exact sum.
  void add_scene_net(const SampledMethod& general, const SampledMethod& exact, int general_hidden,
                     int hidden) {
    RowWork work = general.work;
    work[std::size_t(WorkTerm::hidden)] *= double(hidden) / general_hidden;
    PlannedMethod method;
    method.method = "net";
    method.setting = fmt::format("train --scene --hidden {}", hidden);
    method.ram = kPairSourceBytes;
    method.data = net_flash(kInputs, hidden, kBits);
    add(method, "net", "pairs", work, 0);
    const MethodError& error = find(kMethodErrors, "scene_net");
    const double rays = scene_.convex ? 0 : find(kMethodErrors, "lambert2").factor * exact.error;
    plan_.methods.back().error =
        std::hypot(std::hypot(error.constant, rays), kStopShare * request_.error);
  }

  /// The general network where visible parts lie in flash: how many bytes of it they take depends on
  /// what is seen, so they are made.
  void add_exported() {
    FixedScene fractions(scene_), bits(scene_);
    const auto see = [&](VisibilityCode code, FixedScene* scene) {
      scene->set_visibility(make_visibility(scene_, *scene, code, kSightRays, request_.threads));
    };
    see(VisibilityCode::fractions, &fractions);
    see(VisibilityCode::bits, &bits);
    const double error = add_exported("fractions", fractions, 0);
    add_exported("bits", bits, std::hypot(error, sample_.coarser_error(nets_, bits, fractions)));
  }

  /// error: what the factors are off by if it is known, or 0. What it is, by what is known or sampled.
  double add_exported(const char* name, const FixedScene& exported, double error) {
    const urad_net& net = nets_.find("");
    RowSetting setting;
    setting.hidden = net.hidden;
    const SampledMethod sampled = sample_.run(parse_method("net"), nets_, {}, setting, &exported);
    PlannedMethod method;
    method.method = "net";
    method.setting = fmt::format("bake --visibility {}", name);
    method.ram = kPairSourceBytes;
    method.data = net_flash(net.inputs, net.hidden, net.weight_bits);
    error = std::max(error, sampled.error);
    add(method, "net", "pairs", sampled.work, error, 0, &exported);
    return error;
  }

  void add_table() {
    PlannedMethod method;
    method.method = "table";
    method.ram = kPoseSourceBytes;
    try {
      const PoseLayout layout = pose_layout(scene_, fixed_);
      method.data = layout.bytes();
      add(method, "table", "table", sample_.table_work(layout.block_of), 0);
    } catch (const Error& refused) {
      method.misfit = refused.what();
      plan_.methods.push_back(std::move(method));
    }
  }

  /// The highest bands that the RAM holds; in a convex scene no item buffer.
  void add_hemicube(int resolution, bool hybrid) {
    const bool convex = pod_.flags & URAD_SCENE_CONVEX;
    const std::string text = fmt::format("{}:{}", hybrid ? "hybrid" : "hemicube", resolution);
    const auto ram = [&](int rows) {
      return hemicube_ram(pod_, resolution, rows, hybrid && !convex) +
             (hybrid ? kHybridSourceBytes : 0);
    };
    int rows = convex ? 0 : resolution;
    while (rows > 4 && ram(rows) + solver_ram(pod_) > request_.ram) rows /= 2;
    RowSetting setting;
    const int eyes = hybrid && !convex ? kHybridEyes : 1;
    setting.walks = eyes * hemicube_walks(resolution, convex ? 0 : resolution);
    const urad_net& net = nets_.find("");
    if (hybrid) setting.hidden = net.hidden;
    const SampledMethod sampled = sample_.run(parse_method(text), nets_, {}, setting);
    PlannedMethod method;
    method.method = text;
    if (!convex && rows < resolution) method.setting = fmt::format("bands of {} rows", rows);
    method.ram = ram(rows);
    method.data = hemicube_flash(resolution);
    if (hybrid) method.data += net_flash(net.inputs, net.hidden, net.weight_bits);
    const std::string size = fmt::format("{}{}", resolution, convex ? "_convex" : "");
    const double more = eyes * hemicube_walks(resolution, rows) - setting.walks;
    const RowCost& cube = find(kRowCosts, "hemicube" + size);
    const double more_walks = more * (cube.instructions[std::size_t(WorkTerm::walks)] +
                                      cube.instructions[std::size_t(WorkTerm::drawn)] *
                                          sampled.work[std::size_t(WorkTerm::evaluated)]);
    add(method, (hybrid ? "hybrid" : "hemicube") + size, hybrid ? "hybrid" : "hemicube",
        sampled.work, sampled.error, more_walks);
  }

  void judge() {
    for (PlannedMethod& m : plan_.methods) {
      if (!m.fits()) continue;
      if (m.ram > request_.ram)
        m.misfit =
            fmt::format("needs {} more bytes of RAM", grouped(std::int64_t(m.ram - request_.ram)));
      else if (m.flash() > request_.flash)
        m.misfit = fmt::format("needs {} more bytes of flash",
                               grouped(std::int64_t(m.flash() - request_.flash)));
      else if (m.error > request_.error)
        m.misfit = "not accurate enough";
    }
    std::stable_sort(plan_.methods.begin(), plan_.methods.end(),
                     [](const PlannedMethod& a, const PlannedMethod& b) {
                       return a.fits() != b.fits() ? a.fits() : a.per_solve < b.per_solve;
                     });
    if (plan_.methods.front().fits()) {
      plan_.recommended = 0;
      const PlannedMethod& best = plan_.methods.front();
      plan_.advice = fmt::format("Take {}{}{}: the cheapest that fits.", best.method,
                                 best.setting.empty() ? "" : ", ", best.setting);
      return;
    }
    plan_.advice = what_would_do();
  }

  /// The error to ask for so that a method is within it, its stop included; two digits of it.
  double reachable(const PlannedMethod& m) const {
    const double stop = kStopShare * request_.error;
    const double of_factors = std::sqrt(std::max(m.error * m.error - stop * stop, 0.0));
    return 1.06 * of_factors / std::sqrt(1 - kStopShare * kStopShare);
  }

  /// The least that has to change: an error that something fits, or the memory of what is accurate.
  std::string what_would_do() const {
    const PlannedMethod *accurate = nullptr, *small = nullptr;
    for (const PlannedMethod& m : plan_.methods) {
      if (m.per_solve == 0) continue;  // cannot be had at all
      const bool fits = m.ram <= request_.ram && m.flash() <= request_.flash;
      if (fits && (!small || m.error < small->error)) small = &m;
      if (m.error <= request_.error &&
          (!accurate || m.ram + m.flash() < accurate->ram + accurate->flash()))
        accurate = &m;
    }
    std::string text = "Nothing fits.";
    if (small)
      text += fmt::format(" --error {:.2g} would do for {}.", reachable(*small), small->method);
    if (accurate)
      text +=
          fmt::format(" --ram {} --flash {} would do for {}{}{}.",
                      std::max(accurate->ram, request_.ram == SIZE_MAX ? 0 : request_.ram),
                      std::max(accurate->flash(), request_.flash == SIZE_MAX ? 0 : request_.flash),
                      accurate->method, accurate->setting.empty() ? "" : ", ", accurate->setting);
    if (!small && !accurate) text += " A coarser mesh would do.";
    return text;
  }

  const Scene& scene_;
  const NetChoice& nets_;
  const PlanRequest& request_;
  FixedScene fixed_;
  const urad_scene& pod_;
  Rehearsal rehearsal_;
  Sample sample_;
  Plan plan_;
};

}  // namespace

Plan make_plan(const Scene& scene, const NetChoice& nets, const PlanRequest& request) {
  return Planner(scene, nets, request).make();
}

}  // namespace host
