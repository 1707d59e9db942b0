// docs/SKIPPING.md, written from a run.
#include <fmt/format.h>

#include <cmath>

#include "skipping/skip_report.hpp"

namespace host {
namespace {

std::string grouped(double value) {
  std::string digits = fmt::format("{:.0f}", value);
  for (int k = int(digits.size()) - 3; k > 0; k -= 3) digits.insert(std::size_t(k), ",");
  return digits;
}

std::string per_cent(double part, double whole) {
  return whole > 0 ? fmt::format("{:.1f} %", 100 * part / whole) : "-";
}

template <class Cell>
std::string row(const std::string& name, const std::vector<SkipReport>& reports, const Cell& cell) {
  std::string line = "| " + name;
  for (const SkipReport& r : reports) line += " | " + cell(r);
  return line + " |\n";
}

std::string head(const std::string& first, const std::vector<SkipReport>& reports) {
  std::string line = "| " + first, rule = "| ---";
  for (const SkipReport& r : reports) line += " | " + r.scene, rule += " | ---:";
  return line + " |\n" + rule + " |\n";
}

template <class Pod>
std::string counted(const std::string& name, const std::vector<SkipReport>& reports,
                    Pod SkipReport::*pod, std::uint32_t Pod::*field) {
  return row(name, reports, [&](const SkipReport& r) { return grouped((r.*pod).*field); });
}

std::string sweep_table(const std::vector<SkipReport>& reports) {
  using C = urad_counters;
  constexpr auto pairs = &SkipReport::by_pairs;
  constexpr auto hybrid = &SkipReport::by_hybrid;
  std::string text = head("one sweep, all ordered pairs", reports);
  text += row("patches", reports, [](const SkipReport& r) { return grouped(double(r.patches)); });
  text += row("polygons that can stand between", reports,
              [](const SkipReport& r) { return grouped(double(r.blockers)); });
  text += row("facing, of all pairs", reports, [](const SkipReport& r) {
    return per_cent(double(r.pairs.facing), double(r.pairs.all));
  });
  text += row("partly seen, of those", reports, [](const SkipReport& r) {
    return per_cent(double(r.pairs.partly), double(r.pairs.facing));
  });
  text += row("blocked, of those", reports, [](const SkipReport& r) {
    return per_cent(double(r.pairs.blocked), double(r.pairs.facing));
  });
  text += row("pairs", reports, [](const SkipReport& r) {
    return grouped(double(r.patches) * double(r.patches - 1));
  });
  text += counted("skipped: same surface", reports, pairs, &C::skipped_same);
  text += counted("skipped: wholly behind, with one look", reports, pairs, &C::skipped_behind);
  text += row("skipped: facing away, one by one", reports, [](const SkipReport& r) {
    return grouped(double(r.by_pairs.skipped_facing) - r.by_pairs.skipped_behind);
  });
  text += counted("evaluated", reports, pairs, &C::evaluated);
  text += counted("of those far: no network", reports, pairs, &C::far_pairs);
  text += counted("convex: no thought of blockers", reports, pairs, &C::skipped_convex);
  text += counted("rays", reports, pairs, &C::rays);
  text += counted("rays spared: no blocker reaches between", reports, pairs, &C::rays_spared);
  text += counted("blockers times pairs kept", reports, pairs, &C::blockers_kept);
  text += counted("blockers rejected unseen", reports, pairs, &C::blockers_rejected);
  text += counted("ray against polygon", reports, pairs, &C::ray_tests);
  text += counted("of those settled by box or shadow", reports, pairs, &C::tests_unseen);
  text += counted(fmt::format("left out below a bound of {:.3g} a row", kSkipBound), reports,
                  &SkipReport::bounded, &C::skipped_small);
  text += counted("rays with that bound", reports, &SkipReport::bounded, &C::rays);
  text += counted("hybrid:64, cells", reports, hybrid, &C::cells);
  text += counted("hybrid:64, rows summed", reports, hybrid, &C::rows);
  text += counted("hybrid:64, rows empty", reports, hybrid, &C::rows_empty);
  text += counted("hybrid:64, faces empty", reports, hybrid, &C::faces_empty);
  text += counted("hybrid:64, rays", reports, hybrid, &C::rays);
  return text;
}

double count_of(const SkipReport& r, const std::string& what) {
  const auto at = r.instructions.find(what);
  return at == r.instructions.end() ? 0 : at->second;
}

/// A scene larger than a board's memory has no solver's part.
std::string counted_or_dash(const SkipReport& r, const std::string& what) {
  const double count = count_of(r, what);
  return count > 0 ? grouped(count) : "-";
}

/// Of occluded scenes only.
std::string sight_or_dash(const SkipReport& r, double count) {
  return r.bytes_fractions && count > 0 ? grouped(count) : "-";
}

/// Row and solver together.
double shot(const SkipReport& r, bool all_off) {
  return count_of(r, all_off ? "all" : "on") + count_of(r, all_off ? "solver_all" : "solver_on");
}

/// Instructions of a row with as many rays for every pair as have the error of rays by worth (a power of
/// the rays through what was measured with 16 and 64), over rays by worth. few, many: what 16 and 64 rays take.
/// 0: no rays.
double saved_at_error_of_worth(const SkipReport& r, const char* of_few, const char* of_many) {
  const double few = count_of(r, of_few), many = count_of(r, of_many), on = count_of(r, "worth_64");
  if (!r.bytes_fractions || on <= 0 || many <= 0 || r.error_few <= r.error_fixed) return 0;
  const double ratio = double(kManyRays) / kSkipRays;
  const double power = std::log(r.error_few / r.error_fixed) / std::log(ratio);
  const double rays = std::pow(r.error_few / r.error_worth, 1 / power);  // in kSkipRays
  return (few + (rays - 1) / (ratio - 1) * (many - few)) / on;
}

std::string instruction_table(const std::vector<SkipReport>& reports) {
  std::string text = head("Cortex-M0 instructions of a row of factors", reports);
  text +=
      row("all skips on", reports, [](const SkipReport& r) { return grouped(count_of(r, "on")); });
  for (const auto& [name, label] : std::vector<std::pair<std::string, std::string>>{
           {"same", "same surface off"},
           {"behind", "wholly behind off"},
           {"facing", "facing away off"},
           {"far", "far pairs off"},
           {"convex", "convex off"},
           {"blockers", "blockers unseen off: before any ray"},
           {"unseen", "blockers unseen off: ray by ray"},
           {"order", "the last to stop a ray not first"},
           {"before_rays", "all off, but ray by ray"},
           {"all", "all off"},
           {"bounded", fmt::format("on, and a bound of {:.3g} a row", kSkipBound)}}) {
    text += row(label, reports, [&, what = name](const SkipReport& r) {
      const double on = count_of(r, "on"), off = count_of(r, what);
      return on > 0 ? fmt::format("x {:.2f}", off / on) : "-";
    });
  }
  text += row("solver's part of a shot, skips on", reports,
              [](const SkipReport& r) { return counted_or_dash(r, "solver_on"); });
  text += row("solver's part, all off", reports,
              [](const SkipReport& r) { return counted_or_dash(r, "solver_all"); });
  text += row("to 1 % rms, all on, million", reports, [](const SkipReport& r) {
    return grouped(shot(r, false) * r.early.back().shots[3] / 1e6);
  });
  text += row("to 1 % rms, all off, million", reports, [](const SkipReport& r) {
    return grouped(shot(r, true) * r.early.back().shots[3] / 1e6);
  });
  text += row("**saved at equal error**", reports, [](const SkipReport& r) {
    return shot(r, false) > 0 ? fmt::format("**x {:.2f}**", shot(r, true) / shot(r, false)) : "-";
  });
  text += row("saved, if a ray may still skip by its box", reports, [](const SkipReport& r) {
    const double on = shot(r, false), off = count_of(r, "before_rays") + count_of(r, "solver_all");
    return on > 0 ? fmt::format("x {:.2f}", off / on) : "-";
  });
  text += row("error of B", reports,
              [](const SkipReport& r) { return fmt::format("{:.2f} %", 100 * r.error_few); });
  text += row("exported fractions, bytes of flash", reports,
              [](const SkipReport& r) { return sight_or_dash(r, double(r.bytes_fractions)); });
  text += row("exported fractions, all on: a row of factors", reports,
              [](const SkipReport& r) { return sight_or_dash(r, count_of(r, "sight")); });
  text += row("exported fractions: error of B", reports, [](const SkipReport& r) {
    return r.bytes_fractions ? fmt::format("{:.2f} %", 100 * r.error_fractions) : "-";
  });
  text += row("**saved with exported fractions**", reports, [](const SkipReport& r) {
    const double solver = count_of(r, "solver_on"), row = count_of(r, "sight");
    return row > 0 ? fmt::format("**x {:.2f}**", shot(r, true) / (row + solver)) : "-";
  });
  text += row("exported bits, bytes of flash", reports,
              [](const SkipReport& r) { return sight_or_dash(r, double(r.bytes_bits)); });
  text += row("exported bits: error of B", reports, [](const SkipReport& r) {
    return r.bytes_bits ? fmt::format("{:.2f} %", 100 * r.error_bits) : "-";
  });
  text += row("64 rays a pair, all off: error of B", reports,
              [](const SkipReport& r) { return fmt::format("{:.2f} %", 100 * r.error_fixed); });
  text += row("64 rays by worth, all on: error of B", reports,
              [](const SkipReport& r) { return fmt::format("{:.2f} %", 100 * r.error_worth); });
  text += row("**saved, both within 1 %**", reports, [](const SkipReport& r) {
    const double on = count_of(r, "worth_64");
    return on > 0 ? fmt::format("**x {:.2f}**", count_of(r, "all_64") / on) : "-";
  });
  const auto by_worth = [&](const std::string& name, const char* few, const char* many) {
    return row(name, reports, [=](const SkipReport& r) {
      const double saved = saved_at_error_of_worth(r, few, many);
      return saved > 0 ? fmt::format("x {:.2f}", saved) : "-";
    });
  };
  text += by_worth("saved by worth, where fixed rays have its error", "all", "all_64");
  text += by_worth("the same, all skips on for both", "on", "on_64");
  return text;
}

std::string light_line(const std::vector<SkipReport>& reports) {
  std::string text;
  for (const SkipReport& r : reports) {
    const double one = count_of(r, "light_1"), two = count_of(r, "light_2");
    if (two > one)
      text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", r.scene, grouped(two - one));
  }
  return text.empty() ? "not counted" : text;
}

std::string moved_table(const std::vector<SkipReport>& reports) {
  std::string text =
      "| scene | patches moved | error before | pairs made again, of all | shots to 2 %, from the "
      "start | "
      "to 1 %, from the start | million instructions to 1 %, from the start |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  for (const SkipReport& r : reports) {
    if (!r.moved) continue;
    const MovedAnswer& m = *r.moved;
    // A row asks for n - 1 pairs; a look at all pairs asks for n (n - 1) / 2.
    const double row = count_of(r, "on"), one = row + count_of(r, "solver_on");
    const double again = double(m.made) / double(r.patches - 1) * row + m.shots[3] * one;
    const std::string instructions =
        row > 0 ? fmt::format("{}, {}", grouped(again / 1e6), grouped(m.from_start[3] * one / 1e6))
                : "-";
    text += fmt::format("| {} | {} | {:.1f} % | {} | {}, {} | {}, {} | {} |\n", r.scene, m.patches,
                        100 * m.before, per_cent(m.made, double(m.pairs)), m.shots[2],
                        m.from_start[2], m.shots[3], m.from_start[3], instructions);
  }
  return text;
}

std::string early_charts(const std::vector<SkipReport>& reports, const std::string& chart) {
  std::string text;
  for (const SkipReport& r : reports)
    text += fmt::format("![{} against instructions]({}_{}.svg)\n", r.scene,
                        chart.substr(0, chart.rfind('.')), r.scene);
  return text;
}

std::string early_table(const std::vector<SkipReport>& reports) {
  std::string text =
      "| scene | shown | 10 % | 5 % | 2 % | 1 % | 10 % over 1 % |\n"
      "| --- | --- | ---: | ---: | ---: | ---: | ---: |\n";
  for (const SkipReport& r : reports) {
    const int least = r.early.back().shots[3];
    for (const EarlyAnswer& e : r.early) {
      text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", r.scene, e.name, e.shots[0],
                          e.shots[1], e.shots[2], e.shots[3], per_cent(e.shots[0], least));
    }
  }
  return text;
}

}  // namespace

std::string skip_document(const std::vector<SkipReport>& reports, const std::string& command,
                          const std::string& chart) {
  return fmt::format(
      R"(# What is left out, and what that saves

Written by `{}`.

Every skip has a counter in the run's JSON and report, and a switch for tests. With one skip off the integers are the same
and the work rises by what its counter says (`tests/skipping_test.cpp`). One skip may change light: bounded contribution, off
unless asked for (`urad solve --bound`), which loses at most its bound of a row, and only where rays are spared by it. A pose
table is made beforehand, on the host: poses that are equal but for what six printed decimals leave open share a factor there,
and it states by how much F can differ (`tests/pose_table_test.cpp`); in cube7 all bits are those of every pair for itself.

Rows are those of the general network with {} rays for each pair that a blocker may stand between.

![what becomes of all pairs]({})

{}
## Instructions

Counted on an emulated Cortex-M0 over six rows spread evenly over each scene: times the instructions with all skips on. A
shot is a row and the solver's part; shots to 1 % rms are those of overshooting with ambient term, below. Rays by worth: half
the rays for pairs with a quarter of the factor, from 1/64 down. Exported visibility (`urad bake --visibility`): no rays at all,
of each pair 4 bits in flash (fractions) or one (bits), rows in runs where that is shorter.

Blockers lie in flash in a hierarchy of boxes. What is left of them after the boxes casts a shadow: all segments between two
patches pass outside of one edge, and the blocker is left out, or inside of all, and the pair is shut off without a ray. Edges
that all segments pass inside of are not looked at again, pair by pair and ray by ray. Then a ray is tested: its own box and
its own shadow settle most tests, the blocker that stopped the ray before is asked first, and weights are made where rays
disagree.

"All off" is every skip off, also those of a ray: each ray of a facing pair looks at every polygon of the scene, plane,
crossing and outline, in order, until one stops it. That rays have boxes at all is a skip, too ("ray by ray"); left on while all
the others are off, it is the row "if a ray may still skip by its box".

Fewer instructions to 1 % rms than with all skips off, against the goals of 3 (Cornell, room) and 1.5 (louvre): what is on by
default leaves every bit as it is and is the row "saved at equal error". Rays by worth (`--ray-error`, `urad_pair_source_worth`)
stay within 1 %, too; they are compared with 64 rays for every pair, and with as many as have their error. They are not the
default: beside 64 rays for every pair they save most of the rays and have up to twice the error, and beside as many fixed rays
as have their error what is left is the last row. A caller who has an error in mind asks for them. Exported fractions
are as right as 64 rays, for 19 to 32 KB of flash. `tests/firmware/skipping.sh` counts again, and fails when a scene saves a
tenth less than this table says.

{}
## Early answers

Shots until what is shown is within so much (relative rms) of the converged light of the same factors, largest unshot power
first. The last column: of the shots that overshooting with ambient term takes to 1 %.

{}
The same against instructions, beside patches that shoot in turn with nothing skipped:

{}
## Geometry that moves

The smallest object of a scene moves half its free way (`urad/move.h`); overshooting from the light of before, to that of a solve
from the start. Pairs are those of both looks, the one that takes light away and the one that gives it back; instructions count
them as parts of rows.

{}
## Lights that change colour

One basis a light, mixed by `light_mix`, no shots. Instructions of a light more, all patches: {}.
)",
      command, kSkipRays, chart, sweep_table(reports), instruction_table(reports),
      early_table(reports), early_charts(reports, chart), moved_table(reports),
      light_line(reports));
}

}  // namespace host
