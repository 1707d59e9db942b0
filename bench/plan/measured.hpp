// What bench/plan/measure.sh leaves in a folder: counted rows and solves, and the light of every
// method.
#pragma once
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "plan/work.hpp"
#include "pose/pose_layout.hpp"
#include "scene/builtin.hpp"
#include "urad/patch.hpp"

namespace bench {

struct CountedRow {
  std::string family;
  std::uint16_t patch = 0;
  host::RowWork work{};
  double instructions = 0;
};

struct Measured {
  host::Scene scene;
  host::FixedScene fixed;
  std::vector<CountedRow> rows;
  std::map<std::string, double> bytes;   ///< sizeof on the chip
  std::map<std::string, double> solves;  ///< instructions of whole solves, by family
  double init = 0, solver = 0, shots = 0, updates = 0;

  /// `hidden`: neurons of the network of the image.
  Measured(const std::string& folder, const std::string& scene_name, int hidden)
      : scene(host::load_scene(scene_name)), fixed(scene) {
    read(folder + "/costs.txt", hidden);
    if (std::filesystem::exists(folder + "/solves.txt")) read(folder + "/solves.txt", hidden);
  }

  std::string kind(const std::string& method) const {
    const bool cube = method.rfind("hemicube", 0) == 0 || method.rfind("hybrid", 0) == 0;
    return cube && scene.convex ? method + "_convex" : method;
  }

 private:
  void read(const std::string& path, int hidden) {
    std::ifstream file(path);
    if (!file) throw host::Error(path + " is missing: bench/plan/measure.sh writes it");
    std::vector<std::uint16_t> block_of;
    for (std::string line; std::getline(file, line);) {
      const std::size_t tab = line.find('\t');
      std::istringstream label(line.substr(0, tab));
      const double count = std::stod(line.substr(tab + 1));
      std::string what, name;
      label >> what;
      if (what == "row") {
        if (block_of.empty()) block_of = host::pose_layout(scene, fixed).block_of;
        label >> name;
        read_row(label, name, hidden, count, block_of);
      } else if (what == "bytes") {
        label >> name >> bytes[name];
      } else if (what == "init") {
        init = count;
      } else if (what == "solver") {
        label >> shots >> updates;
        solver += count;
      } else if (what == "solve") {
        label >> name;
        solves[kind(name)] = count;
      }
    }
  }

  void read_row(std::istringstream& label, const std::string& name, int hidden, double count,
                const std::vector<std::uint16_t>& block_of) {
    CountedRow row;
    std::uint32_t runs = 0;
    urad_counters counters{};
    std::array<decltype(counters.evaluated), sizeof counters / sizeof counters.evaluated> counts{};
    label >> row.patch >> runs;
    for (auto& counted : counts) label >> counted;
    std::memcpy(&counters, counts.data(), sizeof counters);
    host::RowSetting setting;
    std::string method = name;
    const urad_scene& pod = fixed.pod();
    const bool bands = method.find("_bands") != method.npos;
    if (bands) method.erase(method.find("_bands"));
    if (method == "net" || method.rfind("hybrid", 0) == 0) setting.hidden = hidden;
    for (const int resolution : {32, 64}) {
      if (method.find(std::to_string(resolution)) == method.npos) continue;
      setting.walks = host::hemicube_walks(resolution, scene.convex ? 0 : bands ? 8 : resolution);
      if (!scene.convex && method.rfind("hybrid", 0) == 0) setting.walks *= host::kHybridEyes;
    }
    if (method == "table") {
      const std::size_t from = urad::surface_of(pod, row.patch);
      for (std::size_t s = 0; s < pod.surface_count; ++s)
        if (block_of[from * pod.surface_count + s] != URAD_POSE_NO_BLOCK)
          setting.grid_rows += pod.surface[s].grid ? pod.surface[s].grid->count_v : 1;
    }
    row.family = kind(method);
    row.work = host::row_work(counters, pod, setting);
    row.instructions = count;
    rows.push_back(row);
  }
};

/// rms of B against the exact solution, the part of stopping taken out; none if there was no solve.
inline double factor_error(const std::string& folder, const std::string& method) {
  std::ifstream file(folder + "/" + method + ".json");
  if (!file) return 0;
  const auto error = nlohmann::json::parse(file).at("error");
  const double exact = error.at("exact_rms"), stop = error.at("converged_rms");
  return std::sqrt(std::max(exact * exact - stop * stop, 0.0));
}

}  // namespace bench
