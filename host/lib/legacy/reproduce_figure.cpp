// Figure 4.3: the cube by the analytic method, the hemicube and the network, and the errors of the
// network's picture.
#include <fmt/format.h>

#include <algorithm>

#include "base/csv.hpp"
#include "base/file.hpp"
#include "legacy/centre_hemicube.hpp"
#include "legacy/reproduce.hpp"
#include "report/picture.hpp"
#include "report/text.hpp"
#include "solve/exact.hpp"
#include "solve/fixed_solve.hpp"

namespace host {

namespace {

constexpr int kPlate = 320, kGap = 8, kHidden = 50, kResolution = 64;

std::string solution_csv(const std::vector<Vec3>& radiosity) {
  std::string text = csv_line({"patch", "B_r", "B_g", "B_b"});
  for (std::size_t k = 0; k < radiosity.size(); ++k)
    text += csv_line({std::to_string(k), csv_number(radiosity[k].x), csv_number(radiosity[k].y),
                      csv_number(radiosity[k].z)});
  return text;
}

/// Three plates a row on white.
Image sheet_of(const std::vector<Image>& plates) {
  const int columns = 3, rows = (int(plates.size()) + columns - 1) / columns;
  Image sheet{columns * kPlate + (columns + 1) * kGap, rows * kPlate + (rows + 1) * kGap, 3, {}};
  sheet.pixels.assign(std::size_t(sheet.width) * std::size_t(sheet.height) * 3, 255);
  for (std::size_t k = 0; k < plates.size(); ++k) {
    const int left = kGap + int(k) % columns * (kPlate + kGap),
              top = kGap + int(k) / columns * (kPlate + kGap);
    for (int y = 0; y < kPlate; ++y)
      for (int x = 0; x < kPlate; ++x)
        for (int c = 0; c < 3; ++c) {
          const Image& plate = plates[k];
          const int from = (y * kPlate + x) * plate.channels + std::min(c, plate.channels - 1);
          const int to = ((top + y) * sheet.width + left + x) * 3 + c;
          sheet.pixels[std::size_t(to)] = plate.pixels[std::size_t(from)];
        }
  }
  return sheet;
}

/// A scale as it is printed, so that readers of the table have the one that was used.
double printed(double scale) { return std::stod(fmt::format("{:.4g}", scale)); }

std::vector<Vec3> one_channel(std::vector<Vec3> b, int channel) {
  for (Vec3& x : b)
    for (int c = 0; c < 3; ++c)
      if (c != channel) x[c] = 0;
  return b;
}

}  // namespace

std::vector<ResultTable> reproduce_figure(const ReproduceRequest& request,
                                          const CubeExperiment& cube) {
  const auto net = std::find_if(cube.nets.begin(), cube.nets.end(), [](const LegacyNetFile& file) {
    return file.net.hidden == kHidden && file.net.scaling == LegacyScaling::linear;
  });
  HemicubeCount count;
  const std::vector<Vec3> exact = exact_radiosity(cube.scene, cube.exact);
  const std::vector<Vec3> hemicube = exact_radiosity(
      cube.scene, centre_hemicube(cube.scene, kResolution, request.threads, &count));
  const std::vector<Vec3> network =
      exact_radiosity(cube.scene, legacy_factors(cube.scene, net->net, request.threads));

  PictureOptions options;
  options.width = options.height = kPlate;
  options.threads = request.threads;
  const View view(cube.scene, options);
  const double white = printed(white_level(cube.scene, exact));
  const double scale = printed(view.difference_scale(network, exact, Shading::kFlat, white));
  std::vector<Image> plates;
  for (const auto* b : {&exact, &hemicube, &network})
    plates.push_back(view.picture(*b, Shading::kFlat, white));
  for (const Channel channel : {Channel::kRed, Channel::kGreen, Channel::kBlue})
    plates.push_back(view.difference(network, exact, Shading::kFlat, scale, channel));
  const auto path = [&](const std::string& name) { return request.folder + "/" + name; };
  for (std::size_t k = 0; k < plates.size(); ++k)
    write_file_atomically(path(fmt::format("figure4.3_plate{}.png", k + 1)), png(plates[k]));
  write_file_atomically(path("figure4.3.png"), png(sheet_of(plates)));
  write_file_atomically(path("solution_analytic.csv"), solution_csv(exact));
  write_file_atomically(path("solution_hemicube.csv"), solution_csv(hemicube));
  write_file_atomically(path("solution_network.csv"), solution_csv(network));

  ResultTable table{"figure4.3",
                    "Figure 4.3: figure4.3.png, plates 1 to 6 from the upper left",
                    {"plate", "shows", "scale", "rms of B", "largest error of B"},
                    {},
                    {}};
  const auto errors = [&](const std::vector<Vec3>& b) {
    return std::vector{percent(relative_rms(cube.scene, b, exact)),
                       percent(relative_max(cube.scene, b, exact))};
  };
  const auto add = [&](const char* shows, double unit, std::vector<std::string> figures) {
    table.rows.push_back({std::to_string(table.rows.size() + 1), shows, fmt::format("{:.4g}", unit),
                          std::move(figures[0]), std::move(figures[1])});
  };
  add("analytic", white, errors(exact));
  add("hemicube", white, errors(hemicube));
  add("network", white, errors(network));
  const char* const shows[] = {"red error", "green error", "blue error"};
  for (int c = 0; c < 3; ++c) {
    const std::vector<Vec3> b = one_channel(network, c), right = one_channel(exact, c);
    add(shows[c], scale,
        {percent(relative_rms(cube.scene, b, right)), percent(relative_max(cube.scene, b, right))});
  }
  table.notes = {
      fmt::format(
          "Scale: the radiosity shown white in plates 1 to 3, the error shown white (black: its "
          "negative) in plates 4 to 6; mid-grey, 128, is no error. Hemicube: {} cells a side. "
          "Network: linear, {} hidden units. All three by elimination, like the report's.",
          kResolution, kHidden),
      "The report's observations: plates 1 and 2 are hard to tell apart; the network's picture "
      "shows neither the right dimming with depth nor the symmetry about the middle, and its "
      "errors "
      "form patterns, not noise. Plates 4 to 6 can be computed again from solution_network.csv and "
      "solution_analytic.csv: 128 + 127 d (128 d where d < 0), d = (network - analytic) / scale, "
      "per patch."};
  if (!request.shortened.empty()) table.notes.push_back(request.shortened);
  return {table};
}

}  // namespace host
