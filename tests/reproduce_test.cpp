// urad reproduce, shortened: what it writes, plates computed again from the solutions, numbers
// computed again from the pairs, and going on after an interruption.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "base/csv.hpp"
#include "base/file.hpp"
#include "legacy/reproduce.hpp"
#include "program.hpp"
#include "scene/builtin.hpp"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#include <stb/stb_image.h>

namespace {

namespace fs = std::filesystem;

using test::urad;

std::string scratch(const std::string& name) { return test::scratch(name).string(); }

double cell(const host::CsvTable& table, std::size_t row, const char* column) {
  return std::stod(table.rows[row].cells[table.column(column)]);
}

/// A PNG as grey or RGB bytes.
struct Picture {
  int width = 0, height = 0, channels = 0;
  std::vector<unsigned char> pixels;
};
Picture read_png(const std::string& path) {
  const std::string file = host::read_file(path);
  Picture picture;
  unsigned char* data =
      stbi_load_from_memory(reinterpret_cast<const unsigned char*>(file.data()), int(file.size()),
                            &picture.width, &picture.height, &picture.channels, 0);
  REQUIRE(data);
  picture.pixels.assign(data, data + picture.width * picture.height * picture.channels);
  stbi_image_free(data);
  return picture;
}

/// The patch of the cube that the middle of a pixel and its surroundings show, or -1: a ray from
/// the eye of the figure, against the five walls, by hand.
int patch_at(const host::Scene& scene, double x, double y, double pixel) {
  int patch = -2;
  for (const double dx : {-0.6, 0.0, 0.6}) {
    for (const double dy : {-0.6, 0.0, 0.6}) {
      const host::Vec3 d(2 * (x + dx * pixel) - 1, 1 - 2 * (y + dy * pixel), 1);
      const host::Vec3 eye(0.5, 0.5, 0.02);
      double near = 1e9;
      for (int k = 0; k < 3; ++k)
        if (d[k] != 0) near = std::min(near, ((d[k] > 0 ? 1.0 : 0.0) - eye[k]) / d[k]);
      const host::Vec3 hit = eye + near * d;
      int found = -1;
      double best = 1e9;
      for (std::size_t k = 0; k < scene.patches.size(); ++k) {
        const double distance = glm::distance(scene.patches[k].moments.centroid, hit);
        if (distance < best) best = distance, found = int(k);
      }
      if (patch != -2 && patch != found) return -1;
      patch = found;
    }
  }
  return patch;
}

}  // namespace

TEST_CASE("plates 4 to 6 are the errors of the solutions that were written") {
  const std::string folder = scratch("figure");
  REQUIRE(urad("reproduce figure4.3 --epochs 2 -o " + folder).status == 0);
  const host::CsvTable exact = host::read_csv(folder + "/solution_analytic.csv"),
                       network = host::read_csv(folder + "/solution_network.csv"),
                       plates = host::read_csv(folder + "/figure4.3.csv");
  const host::Scene scene = host::load_scene("cube7");
  REQUIRE(exact.rows.size() == 294);
  REQUIRE(plates.rows.size() == 6);
  const Picture sheet = read_png(folder + "/figure4.3.png");
  const char* channels[] = {"B_r", "B_g", "B_b"};
  int compared = 0, worst = 0;
  for (int c = 0; c < 3; ++c) {
    const Picture plate = read_png(fmt::format("{}/figure4.3_plate{}.png", folder, 4 + c));
    REQUIRE(plate.channels == 1);
    const double scale = cell(plates, std::size_t(3 + c), "scale");
    for (int y = 0; y < plate.height; y += 7) {
      for (int x = 0; x < plate.width; x += 7) {
        const int patch =
            patch_at(scene, (x + 0.5) / plate.width, (y + 0.5) / plate.height, 1.0 / plate.width);
        if (patch < 0) continue;
        const double d = (cell(network, std::size_t(patch), channels[c]) -
                          cell(exact, std::size_t(patch), channels[c])) /
                         scale;
        const double grey = 128 + (d < 0 ? 128 : 127) * std::clamp(d, -1.0, 1.0);
        const int shown = plate.pixels[std::size_t(y * plate.width + x)];
        worst = std::max(worst, int(std::fabs(shown - grey) + 0.49));
        ++compared;
        // The same pixel of the sheet: second row, column c, gaps of 8.
        const int left = 8 + c * (plate.width + 8) + x, top = 16 + plate.height + y;
        for (int k = 0; k < 3; ++k)
          CHECK(sheet.pixels[std::size_t((top * sheet.width + left) * 3 + k)] == shown);
      }
    }
  }
  CHECK(compared > 3000);
  CHECK(worst <= 1);
}

TEST_CASE("the tables follow from the pairs that were written, and say what was shortened") {
  host::ReproduceRequest request;
  request.folder = scratch("random");
  request.epochs = 2;
  request.share = 0.02;
  request.shortened = "Shortened.";
  request.quiet = true;
  const host::ResultTable decades = host::reproduce_random(request).at(1);
  CHECK(decades.notes.back() == "Shortened.");
  const host::CsvTable pairs = host::read_csv(request.folder + "/random_pairs.csv"),
                       table = host::parse_csv(host::to_csv(decades), "table3.2");
  const double edges[] = {0, 1e-4, 1e-3, 1e-2, 1e-1, 1};
  REQUIRE(table.rows.size() == 5);
  for (std::size_t bin = 0; bin < 5; ++bin) {
    double sum = 0;
    int count = 0;
    for (std::size_t k = 0; k < pairs.rows.size(); ++k) {
      const double f = cell(pairs, k, "exact");
      if (f <= edges[bin] || f > edges[bin + 1]) continue;
      sum += cell(pairs, k, "network") - f;
      ++count;
    }
    REQUIRE(count > 0);
    CHECK(cell(table, bin, "samples") == count);
    CHECK(cell(table, bin, "NN mean") == doctest::Approx(sum / count).epsilon(0.01));
  }
}

TEST_CASE("finished networks are kept, those of another command are trained again") {
  host::ReproduceRequest request;
  request.folder = scratch("resume");
  request.epochs = 2;
  request.quiet = true;
  const auto first = host::cube_experiment(request, 5);
  const std::string path = request.folder + "/nets/linear5.json", text = host::read_file(path);
  REQUIRE(first.nets.size() == 1);
  const auto stamp = fs::last_write_time(path);
  CHECK(host::cube_experiment(request, 5).nets[0].net.hidden_weight ==
        first.nets[0].net.hidden_weight);
  CHECK(fs::last_write_time(path) == stamp);
  host::write_file_atomically(path, text.substr(0, 100));  // cut short: not used
  CHECK(host::cube_experiment(request, 5).nets[0].net.hidden_weight ==
        first.nets[0].net.hidden_weight);
  CHECK(host::read_file(path) == text);
  request.epochs = 3;
  CHECK(host::cube_experiment(request, 5).nets[0].epochs == 3);
  CHECK_FALSE(fs::exists(path + ".partial"));
}

TEST_CASE("a bias makes light grow, spread of the printed size does not") {
  Eigen::MatrixXd f = Eigen::MatrixXd::Constant(50, 50, 1.0 / 50);
  CHECK(host::spectral_radius(f) == doctest::Approx(1));
  CHECK(host::spectral_radius(f.array() + 0.01) == doctest::Approx(1.5));
  const Eigen::MatrixXd turn = (Eigen::MatrixXd(2, 2) << 0, 2, -2, 0).finished();
  CHECK(host::spectral_radius(turn) == doctest::Approx(2));  // a pair of complex eigenvalues
}

TEST_CASE("wrong usage is refused before anything is written") {
  const std::string folder = scratch("refused") + "/new";
  CHECK(urad("reproduce table9.9 -o " + folder).status == 2);
  CHECK(urad("reproduce table4.1 --epochs 0 -o " + folder).status == 2);
  CHECK(urad("reproduce table4.1").status == 2);
  CHECK_FALSE(fs::exists(folder));
  CHECK(urad("reproduce table4.1 -o /proc/none").status == 1);
}
