#include "plan_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "base/file.hpp"
#include "chip_light.hpp"
#include "measured.hpp"
#include "plan/chip_bytes.hpp"
#include "plan/plan.hpp"
#include "report/text.hpp"
#include "weights/general.h"

namespace bench {

namespace {

const host::NetChoice kNets{[](const std::string&) -> const urad_net* { return &urad_general; }};
constexpr double kStop = 0.01;

struct Case {
  std::string seed, method;
  double shot_ratio = 0, solve_ratio = 0, planned_error = 0, error = 0;
  double planned_solve = 0, solve = 0;
};

/// The name that the counted solves carry.
std::string family_of(const host::PlannedMethod& m, bool convex) {
  if (!m.setting.empty()) return {};
  std::string name = m.method;
  if (name.rfind("fixed-", 0) == 0) name.erase(0, 6);
  std::erase(name, ':');
  const bool cube = name.rfind("hemicube", 0) == 0 || name.rfind("hybrid", 0) == 0;
  return cube && convex ? name + "_convex" : name;
}

/// Bytes of tables as the compiler laid them out (data.txt: what, bytes).
std::map<std::string, std::size_t> laid_out(const std::string& path) {
  std::istringstream lines(host::read_file(path));
  std::map<std::string, std::size_t> bytes;
  for (std::string what; lines >> what;) lines >> bytes[what];
  return bytes;
}

/// Sizes that differ from what the chip's compiler says; 0 is what is promised.
int wrong_bytes(const Measured& m, const host::Plan& plan, const std::string& folder) {
  const std::pair<const char*, std::size_t> objects[] = {
      {"state", host::kStateBytes},
      {"counters", host::kCountersBytes},
      {"pair_source", host::kPairSourceBytes},
      {"pose_source", host::kPoseSourceBytes},
      {"hemicube_source", host::kHemicubeSourceBytes},
      {"hybrid_source", host::kHybridSourceBytes}};
  int wrong = 0;
  for (const auto& [name, bytes] : objects) wrong += m.bytes.at(name) != double(bytes);
  const auto data = laid_out(folder + "/data.txt");
  for (const host::PlannedMethod& line : plan.methods) {
    const std::string family = family_of(line, m.scene.convex);
    // The image was baked with the repair of the network's rows; a table has none.
    const std::size_t scale = m.scene.closed ? 4 * m.scene.patches.size() : 0;
    if (family == "net") wrong += line.data != data.at("scene") + data.at("net");
    if (family == "moment" || family == "lambert1") wrong += line.data != data.at("scene");
    if (family == "table") wrong += line.data != data.at("scene") - scale + data.at("poses");
  }
  return wrong;
}

double factor(double a, double b) { return std::max(a / b, b / a); }

std::string table(const std::vector<Case>& cases) {
  std::string text =
      "| scene | method | instructions planned | counted | planned / counted | error planned | "
      "measured |\n"
      "| --- | --- | ---: | ---: | ---: | ---: | ---: |\n";
  for (const Case& c : cases)
    text += fmt::format("| {} | {} | {} | {} | {:.2f} | {} | {} |\n", c.seed, c.method,
                        host::metric(c.planned_solve), host::metric(c.solve), c.solve_ratio,
                        host::percent(c.planned_error), host::percent(c.error));
  return text;
}

}  // namespace

void check(const std::string& work, const std::string& out, const std::vector<std::string>& seeds) {
  std::vector<Case> cases;
  int wrong = 0;
  double slowest = 0;
  for (const std::string& seed : seeds) {
    const std::string folder = fmt::format("{}/{}", work, seed);
    const Measured m(folder, folder + "/room.obj", urad_general.hidden);
    const auto start = std::chrono::steady_clock::now();
    const host::Plan plan = host::make_plan(m.scene, kNets, {});
    slowest = std::max(
        slowest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    wrong += wrong_bytes(m, plan, folder);
    for (const host::PlannedMethod& line : plan.methods) {
      const auto counted = m.solves.find(family_of(line, m.scene.convex));
      if (counted == m.solves.end()) continue;
      Case c{seed, line.method, 0, 0, line.error, 0, line.per_solve, counted->second};
      c.solve_ratio = line.per_solve / counted->second;
      c.error = chip_light_error(m.scene, host::parse_method(line.method), kNets, kStop);
      cases.push_back(c);
      fmt::print("{} {:<16} solve {:.2f}  error {} of {}, factor {:.2f}\n", seed, line.method,
                 c.solve_ratio, host::percent(line.error), host::percent(c.error),
                 factor(line.error, c.error));
    }
  }
  const auto count = [&](auto&& good) { return std::count_if(cases.begin(), cases.end(), good); };
  const auto instructions =
      count([](const Case& c) { return std::abs(c.solve_ratio - 1) <= 0.15; });
  const auto errors = count([](const Case& c) { return factor(c.planned_error, c.error) <= 2; });
  std::string text = host::read_file(std::string(URAD_SOURCE_DIR) + "/bench/plan/PLAN.md.in");
  text += fmt::format(
      "## Tested on {} scenes that no constant has seen\n\n"
      "Written by `./run plan` (seeds {}): --error 0.01, every method of every scene, whole "
      "solves.\n\n"
      "| what | goal | reached |\n| --- | --- | --- |\n"
      "| sizes that differ from the compiler's | 0 | {} |\n"
      "| instructions of a solve within 15 % | all | {} of {} |\n"
      "| error of B within a factor 2 | all | {} of {} |\n"
      "| slowest plan | 1 s | {:.2f} s |\n\n",
      seeds.size(), fmt::join(seeds, ", "), wrong, instructions, cases.size(), errors, cases.size(),
      slowest);
  host::write_file_atomically(out, text + table(cases));
}

}  // namespace bench
