// All that a bake found out, as plain data: report.html and report.json are written from it.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "report/picture.hpp"
#include "urad/radiosity.h"

namespace host {

/// A name and what belongs to it, in the order in which they are shown.
struct Fact {
  std::string name, value;
};

/// The solver's ledger in its integer power units, each term summed on its own; red, green, blue.
struct EnergyAudit {
  std::array<std::int64_t, 3> emitted{}, absorbed{}, unshot{}, escaped{};
  /// What the books are off by in a channel: absorbed + unshot + escaped - emitted. 0 when they
  /// balance.
  std::int64_t gap(std::size_t channel) const {
    return absorbed[channel] + unshot[channel] + escaped[channel] - emitted[channel];
  }
  bool exact() const { return gap(0) == 0 && gap(1) == 0 && gap(2) == 0; }
};

/// Errors against the exact solution and the exact factors; empty where nobody looked.
struct MethodErrors {
  std::optional<double> b_rms;         ///< rms of B - exact, as a fraction of the rms of exact
  std::optional<double> b_max;         ///< largest |B - exact|, as a fraction of the rms of exact
  std::optional<double> f_std, f_max;  ///< of F, absolute
  std::optional<double> row_mean, row_worst;  ///< |sum of a row of F - 1|, before repair
};

/// The pictures of one method as PNG files' bytes; empty where there is none.
struct MethodPictures {
  std::string smooth, flat;
  std::string difference;                         ///< RGB
  std::array<std::string, 3> channel_difference;  ///< grey: red, green, blue
  double difference_scale =
      0;  ///< white and black of the differences, as a fraction of the pictures' white
};

struct MethodResult {
  std::string name;        ///< as after --method
  std::string title;       ///< for people; empty: the name
  bool reference = false;  ///< the exact solution that the others are measured against
  std::vector<Vec3> B;     ///< radiosity per patch, in the unit of the emission
  MethodErrors errors;
  std::optional<std::uint32_t> shots;
  std::optional<double> seconds;                   ///< host, whole solve
  std::optional<double> ns_per_pair;               ///< host, one form factor
  std::optional<double> m0_instructions_per_pair;  ///< Cortex-M0, counted
  std::optional<double> m0_instructions;           ///< Cortex-M0, whole solve
  std::optional<std::int64_t> ram_bytes, flash_bytes;
  std::vector<Fact> memory;               ///< what the bytes are: "solver state" -> "7,056 B RAM"
  std::optional<urad_counters> counters;  ///< of one sweep: every row of factors once
  std::optional<urad_radiosity_counters> solver;  ///< of the solve
  std::optional<EnergyAudit> audit;
  MethodPictures pictures;

  const std::string& label() const { return title.empty() ? name : title; }
};

struct BakeReport {
  std::string title;                   ///< of the scene, for people
  std::string scene;                   ///< as on the command line
  std::string version;                 ///< of urad
  std::string command;                 ///< what was run
  std::vector<Fact> facts;             ///< patches, surfaces, size, lamp, ...
  std::vector<Fact> network;           ///< how the scene's network was trained and what it scored
  std::vector<Fact> files;             ///< file name -> what it holds
  std::vector<std::string> reproduce;  ///< commands, one a line
  std::vector<MethodResult> methods;   ///< in the order in which they are shown

  /// The exact solution, or null.
  const MethodResult* reference() const {
    for (const MethodResult& method : methods)
      if (method.reference) return &method;
    return nullptr;
  }
};

/// Renders every method that has a solution, all with the white level of the reference (of the
/// first method when there is none); differences where there is a reference.
void add_pictures(const Scene& scene, const PictureOptions& options, BakeReport* report);

/// report.json: the same facts for programs, without solutions and pictures. Several scenes: an
/// array "scenes".
std::string report_json(const std::vector<BakeReport>& reports);

}  // namespace host
