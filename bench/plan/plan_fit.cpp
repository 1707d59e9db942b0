// urad_plan_fit -- makes and tests the constants of `urad plan`.
//
//   urad_plan_fit scene SEED DIR              DIR/room.obj and .mtl (random_scene.hpp)
//   urad_plan_fit fit WORK OUT SEED...        writes OUT (host/lib/plan/constants.hpp)
//   urad_plan_fit check WORK OUT SEED...      plans each scene and writes what came of it, as a table
//
// WORK is where measure.sh and code.sh have been.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cstdio>
#include <set>

#include "base/file.hpp"
#include "chip_light.hpp"
#include "measured.hpp"
#include "plan/model.hpp"
#include "plan/sample.hpp"
#include "plan_check.hpp"
#include "random_scene.hpp"
#include "weights/cube7.h"
#include "weights/general.h"

namespace {

using bench::Measured;

const host::NetChoice kNets{[](const std::string&) -> const urad_net* { return &urad_general; }};
constexpr double kStop = 0.01;

struct Named {
  const char *family, *method, *file;  // of the constants, of the program, of the report
};
constexpr Named kMethods[] = {{"moment", "fixed-moment", "fixed-moment"},
                              {"net", "net", "net"},
                              {"lambert1", "fixed-lambert:1", "fixed-lambert_1"},
                              {"lambert2", "fixed-lambert:2", "fixed-lambert_2"},
                              {"hemicube32", "hemicube:32", "hemicube_32"},
                              {"hemicube64", "hemicube:64", "hemicube_64"},
                              {"hybrid32", "hybrid:32", "hybrid_32"},
                              {"hybrid64", "hybrid:64", "hybrid_64"}};

/// Least squares of relative errors with no coefficient below 0 [Lawson & Hanson 1974].
std::vector<double> fit(const std::vector<std::vector<double>>& terms,
                        const std::vector<double>& values) {
  const auto rows = Eigen::Index(terms.size()), n = Eigen::Index(terms.front().size());
  Eigen::MatrixXd a(rows, n);
  for (Eigen::Index r = 0; r < rows; ++r)
    for (Eigen::Index c = 0; c < n; ++c)
      a(r, c) = terms[std::size_t(r)][std::size_t(c)] / values[std::size_t(r)];
  Eigen::VectorXd scale = a.colwise().norm();
  for (Eigen::Index c = 0; c < n; ++c) a.col(c) /= scale[c] = scale[c] > 0 ? scale[c] : 1;
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(rows);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::Index> in;
  const auto solve = [&] {
    Eigen::MatrixXd part(rows, Eigen::Index(in.size()));
    for (std::size_t k = 0; k < in.size(); ++k) part.col(Eigen::Index(k)) = a.col(in[k]);
    const Eigen::VectorXd y = part.colPivHouseholderQr().solve(b);
    Eigen::VectorXd z = Eigen::VectorXd::Zero(n);
    for (std::size_t k = 0; k < in.size(); ++k) z[in[k]] = y[Eigen::Index(k)];
    return z;
  };
  for (int round = 0; round < 10 * n; ++round) {
    const Eigen::VectorXd gain = a.transpose() * (b - a * x);
    Eigen::Index next = -1;
    for (Eigen::Index c = 0; c < n; ++c) {
      const bool inside = std::find(in.begin(), in.end(), c) != in.end();
      if (!inside && gain[c] > 1e-9 && (next < 0 || gain[c] > gain[next])) next = c;
    }
    if (next < 0) break;
    in.push_back(next);
    Eigen::VectorXd z = solve();
    while (!in.empty() &&
           std::any_of(in.begin(), in.end(), [&](Eigen::Index c) { return z[c] <= 0; })) {
      double step = 1;
      for (const Eigen::Index c : in)
        if (z[c] <= 0) step = std::min(step, x[c] / (x[c] - z[c]));
      x += step * (z - x);
      std::erase_if(in, [&](Eigen::Index c) { return x[c] <= 1e-12; });
      for (Eigen::Index c = 0; c < n; ++c)
        if (std::find(in.begin(), in.end(), c) == in.end()) x[c] = 0;
      z = solve();
    }
    x = z;
  }
  const Eigen::VectorXd result = x.array() / scale.array();
  return {result.data(), result.data() + n};
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

std::vector<double> list(const host::RowWork& work) { return {work.begin(), work.end()}; }

std::string seed_folder(const std::string& work, const std::string& seed) {
  return work + "/" + seed;
}
Measured measured_seed(const std::string& work, const std::string& seed) {
  const std::string folder = seed_folder(work, seed);
  return Measured(folder, folder + "/room.obj", urad_general.hidden);
}

/// Fitted rows, with the worst mean over a scene beside them.
std::string row_costs(const std::vector<Measured>& scenes) {
  std::set<std::string> families;
  for (const Measured& m : scenes)
    for (const bench::CountedRow& row : m.rows) families.insert(row.family);
  std::string text =
      fmt::format("inline constexpr std::array<RowCost, {}> kRowCosts = {{\n", families.size());
  for (const std::string& family : families) {
    std::vector<std::vector<double>> terms;
    std::vector<double> values;
    for (const Measured& m : scenes)
      for (const bench::CountedRow& row : m.rows)
        if (row.family == family)
          terms.push_back(list(row.work)), values.push_back(row.instructions);
    const std::vector<double> x = fit(terms, values);
    double worst = 0;
    for (const Measured& m : scenes) {
      double right = 0, fitted = 0;
      for (const bench::CountedRow& row : m.rows)
        if (row.family == family) right += row.instructions, fitted += dot(x, list(row.work));
      if (right > 0) worst = std::max(worst, std::abs(fitted / right - 1));
    }
    std::vector<std::string> parts;
    for (std::size_t k = 0; k < x.size(); ++k)
      if (x[k] != 0)
        parts.push_back(fmt::format("{{WorkTerm::{}, {:.5g}}}", host::kWorkNames[k], x[k]));
    text +=
        fmt::format("    // {} rows, worst scene off by {:.1f} %\n    row_cost(\"{}\", {{{}}}),\n",
                    values.size(), 100 * worst, family, fmt::join(parts, ", "));
    fmt::print("{:<18} {:5} rows, worst scene {:.1f} %\n", family, values.size(), 100 * worst);
  }
  return text + "};\n";
}

std::string solver_cost(const std::vector<Measured>& scenes) {
  std::vector<std::vector<double>> shots, inits;
  std::vector<double> per_shot, init;
  for (const Measured& m : scenes) {
    if (m.shots == 0) continue;
    shots.push_back({1, double(m.fixed.pod().surface_count), double(m.fixed.pod().patch_count),
                     m.updates / m.shots});
    per_shot.push_back(m.solver / m.shots);
    inits.push_back({1, double(m.fixed.pod().patch_count)});
    init.push_back(m.init);
  }
  const std::vector<double> x = fit(shots, per_shot), y = fit(inits, init);
  double worst = 0;
  for (std::size_t k = 0; k < shots.size(); ++k)
    worst = std::max(worst, std::abs(dot(x, shots[k]) / per_shot[k] - 1));
  fmt::print("{:<18} {:5} solves, worst {:.1f} %\n", "solver", shots.size(), 100 * worst);
  return fmt::format(
      "// {} solves, worst off by {:.1f} %\n"
      "inline constexpr SolverCost kSolverCost{{{:.6g}, {:.6g}, {:.6g}, {:.6g}, {:.6g}, "
      "{:.6g}}};\n",
      shots.size(), 100 * worst, x[0], x[1], x[2], x[3], y[0], y[1]);
}

struct Ratios {
  std::vector<double> value;
  double middle() const {
    double sum = 0;
    for (const double r : value) sum += std::log(r);
    return std::exp(sum / double(value.size()));
  }
  double worst() const {
    double most = 1;
    for (const double r : value) most = std::max({most, r / middle(), middle() / r});
    return most;
  }
};

std::string error_model(const std::string& work, const std::vector<std::string>& seeds,
                        const std::vector<Measured>& scenes) {
  std::map<std::string, Ratios> ratios;
  Ratios scene_net, stop;
  for (std::size_t k = 0; k < seeds.size(); ++k) {
    const Measured& m = scenes[k];
    const std::string folder = seed_folder(work, seeds[k]);
    const host::Rehearsal rehearsal = host::rehearse(m.fixed, kStop);
    const host::Sample sample(m.scene, m.fixed, rehearsal, 0);
    for (const Named& named : kMethods) {
      const double right = bench::factor_error(folder, named.file);
      const double sampled = sample.run(host::parse_method(named.method), kNets, {}, {}).error;
      if (right > 0 && sampled > 0) ratios[m.kind(named.family)].value.push_back(right / sampled);
    }
    const double trained = bench::factor_error(folder, "scene_net");
    if (m.scene.convex && trained > 0) scene_net.value.push_back(trained);
    stop.value.push_back(bench::chip_light_error(m.scene, {"table", ""}, kNets, kStop) / kStop);
  }
  std::string text = fmt::format(
      "inline constexpr std::array<MethodError, {}> kMethodErrors = {{{{\n", ratios.size() + 2);
  const auto line = [&](const std::string& family, const Ratios& r, bool factor) {
    text += fmt::format(
        "    // {} scenes, worst off by a factor {:.2f}\n    {{\"{}\", {:.4g}, {:.4g}}},\n",
        r.value.size(), r.worst(), family, factor ? r.middle() : 0, factor ? 0 : r.middle());
    fmt::print("{:<18} {:5} scenes, error {:.3g}, worst factor {:.2f}\n", family, r.value.size(),
               r.middle(), r.worst());
  };
  for (const auto& [family, r] : ratios) line(family, r, true);
  line("scene_net", scene_net, false);
  text += "    {\"table\", 0, 0},\n}};\n";
  fmt::print("{:<18} {:5} scenes, {:.3g}, worst factor {:.2f}\n", "stop", stop.value.size(),
             stop.middle(), stop.worst());
  return text + fmt::format(
                    "// rms reached over the engine's estimate of 1 %: {} scenes, worst off by a "
                    "factor {:.2f}\n"
                    "inline constexpr double kStopShare = {:.4g};\n",
                    stop.value.size(), stop.worst(), stop.middle());
}

std::string code_sizes(const std::string& work) {
  std::istringstream lines(host::read_file(work + "/code.txt"));
  std::string text, word, kind;
  int count = 0;
  for (std::size_t bytes; lines >> word >> kind >> bytes; ++count)
    text += fmt::format("    {{\"{}\", {}}},\n", kind, bytes);
  return fmt::format("inline constexpr std::array<MethodCode, {}> kMethodCode = {{{{\n{}}}}};\n",
                     count, text);
}

void make_constants(const std::string& work, const std::string& out,
                    const std::vector<std::string>& seeds) {
  std::vector<Measured> scenes;
  scenes.reserve(seeds.size());
  for (const std::string& seed : seeds) scenes.push_back(measured_seed(work, seed));
  std::vector<Measured> with_cube = scenes;  // a network of four neurons, for what a neuron costs
  with_cube.emplace_back(work + "/cube7", "cube7", urad_cube7.hidden);
  std::string text = fmt::format(
      "// GENERATED by `urad_plan_fit fit`, seeds {} -- do not edit. How: docs/PLAN.md.\n"
      "#pragma once\n#include <array>\n\n#include \"plan/model.hpp\"\n\nnamespace host {{\n\n",
      fmt::join(seeds, " "));
  text += row_costs(with_cube) + "\n" + solver_cost(with_cube) + "\n" +
          error_model(work, seeds, scenes) + "\n" + code_sizes(work);
  host::write_file_atomically(out, text + "\n}  // namespace host\n");
}

}  // namespace

int main(int argc, char** argv) try {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() == 3 && words[0] == "scene") {
    const bench::SceneText text = bench::RandomScene(unsigned(std::stoul(words[1]))).make();
    host::write_file_atomically(words[2] + "/room.obj", text.obj);
    host::write_file_atomically(words[2] + "/room.mtl", text.mtl);
  } else if (words.size() > 3 && words[0] == "fit") {
    make_constants(words[1], words[2], {words.begin() + 3, words.end()});
  } else if (words.size() > 3 && words[0] == "check") {
    bench::check(words[1], words[2], {words.begin() + 3, words.end()});
  } else {
    fmt::print(stderr,
               "urad_plan_fit scene SEED DIR | fit WORK OUT SEED... | check WORK OUT SEED...\n");
    return 2;
  }
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "urad_plan_fit: {}\n", error.what());
  return 1;
}
