#include "solve/exact.hpp"

#include <doctest/doctest.h>

#include <random>

#include "base/error.hpp"
#include "form_factor/reference.hpp"
#include "random_room.hpp"
#include "scene/builtin.hpp"
#include "scene/obj.hpp"
#include "solve/embree_visibility.hpp"
#include "solve/repair.hpp"

using host::Vec3;

namespace {

// Patches without materials or grouping, for pairs.
host::Scene scene_of(const std::vector<host::Polygon>& patches,
                     const std::vector<host::Polygon>& blockers) {
  host::Scene scene;
  scene.materials.emplace_back();
  for (const host::Polygon& polygon : patches) {
    host::Surface surface;
    surface.first_patch = int(scene.patches.size());
    surface.patch_count = 1;
    scene.patches.push_back({polygon, host::moments(polygon), surface.first_patch});
    scene.surfaces.push_back(surface);
  }
  for (const host::Polygon& polygon : blockers) scene.blockers.push_back({polygon, -1});
  return scene;
}

host::Polygon square(double low, double high, double z) {
  return {{{low, low, z}, {high, low, z}, {high, high, z}, {low, high, z}}, {}};
}

host::Polygon down(host::Polygon polygon) {
  std::swap(polygon.outer[1], polygon.outer[3]);
  return polygon;
}

double worst_row(const Eigen::MatrixXd& f) {
  return (f.rowwise().sum().array() - 1).abs().maxCoeff();
}

}  // namespace

TEST_CASE("rows of closed rooms sum to 1 and their exchanges are symmetric") {
  const host::Scene cube = host::load_scene("cube7");
  CHECK(worst_row(host::exact_form_factors(cube)) < 1e-12);
  constexpr unsigned seed = 1996;
  CAPTURE(seed);
  std::mt19937 random(seed);
  const test::RandomRoom room = test::random_room(random, 1e-3);
  const host::Scene scene =
      host::parse_obj(room.obj, "room.obj", {}, [&](const std::string&) { return room.mtl; });
  const Eigen::MatrixXd f = host::exact_form_factors(scene);
  CHECK(worst_row(f) < 3e-6);  // six printed decimals leave the walls that far apart
  for (Eigen::Index i = 0; i < f.rows(); i += 7)
    for (Eigen::Index j = 0; j < f.rows(); j += 5)
      REQUIRE(scene.patches[std::size_t(i)].moments.area * f(i, j) ==
              doctest::Approx(scene.patches[std::size_t(j)].moments.area * f(j, i)).epsilon(1e-14));
}

TEST_CASE("a matrix does not depend on the number of threads") {
  const host::Scene scene = host::load_scene("cornell", {2, 0});
  CHECK(host::exact_form_factors(scene, 1, 64) == host::exact_form_factors(scene, 3, 64));
}

TEST_CASE("white furnace: B = E / (1 - rho) in a closed room") {
  host::Scene scene = host::load_scene("cube7");
  const Eigen::MatrixXd f = host::exact_form_factors(scene);
  for (const double rho : {0.0, 0.5, 0.9, 0.99}) {
    for (host::Material& m : scene.materials) m.reflectance = Vec3(rho), m.exitance = Vec3(2, 1, 0);
    for (const Vec3& b : host::exact_radiosity(scene, f))
      REQUIRE(glm::length(b - Vec3(2, 1, 0) / (1 - rho)) < 1e-9);
  }
  for (host::Material& m : scene.materials) m.reflectance = Vec3(1);
  CHECK_THROWS_WITH_AS(host::exact_radiosity(scene, f), doctest::Contains("never dies"),
                       host::Error);
  CHECK_THROWS_AS(host::exact_radiosity(scene, Eigen::MatrixXd(3, 3)), host::Error);
}

TEST_CASE("two plates solve like the two-surface exchange formula") {
  // B1 = E + rho F B2, B2 = rho F B1, F = 0.199824895698387 [Howell C-11].
  host::Scene scene = scene_of({square(0, 1, 0), down(square(0, 1, 1))}, {});
  scene.surfaces[1].material = 1;
  scene.materials = {{"lamp", Vec3(0.5), Vec3(1)}, {"plate", Vec3(0.5), Vec3(0)}};
  const std::vector<Vec3> b = host::exact_radiosity(scene, host::exact_form_factors(scene));
  const double x = 0.5 * 0.199824895698387;
  CHECK(b[0].x == doctest::Approx(1 / (1 - x * x)).epsilon(1e-13));
  CHECK(b[1].z == doctest::Approx(x / (1 - x * x)).epsilon(1e-13));
}

TEST_CASE("what a closed room emits it absorbs") {
  const host::Scene scene = host::load_scene("cube7");
  const std::vector<Vec3> b = host::exact_radiosity(scene, host::exact_form_factors(scene));
  Vec3 emitted(0), absorbed(0);
  for (std::size_t k = 0; k < b.size(); ++k) {
    const host::Material& m = scene.material_of(k);
    emitted += m.exitance * scene.patches[k].moments.area;
    // Irradiance from B = E + rho H; the black lamp's comes from the whole balance.
    if (m.reflectance != Vec3(0))
      absorbed += (1.0 - m.reflectance) * (b[k] - m.exitance) / m.reflectance *
                  scene.patches[k].moments.area;
  }
  const Eigen::MatrixXd f = host::exact_form_factors(scene);
  for (std::size_t k = 245; k < b.size(); ++k)
    for (std::size_t j = 0; j < b.size(); ++j)
      absorbed += f(Eigen::Index(k), Eigen::Index(j)) * b[j] * scene.patches[k].moments.area;
  CHECK(glm::length(absorbed - emitted) < 1e-12);
}

TEST_CASE("visible fractions of the public blocker cases") {
  const host::Polygon p = square(0, 1, 0), q = down(square(0, 1, 1));
  const auto f = [&](const host::Polygon& blocker, int rays) {
    const host::Scene scene = scene_of({p, q}, {blocker});
    return host::EmbreeVisibility(scene, rays).fraction(0, 1) * host::reference_form_factor(p, q);
  };
  CHECK(std::abs(f(square(0, 0.5, 0.5), 256) - 0.149868671773791) < 3e-3);
  CHECK(std::abs(f(square(0.25, 0.75, 0.5), 256) - 0.0995062945989848) < 3e-3);
  CHECK(std::abs(f(square(0, 0.5, 0.5), 65536) - 0.149868671773791) < 2e-4);
  CHECK(std::abs(f(square(0.25, 0.75, 0.5), 65536) - 0.0995062945989848) < 2e-4);
  CHECK(f(square(-9, 9, 0.5), 256) == 0);
  CHECK(f(square(-9, 9, -0.5), 256) == host::reference_form_factor(p, q));
  CHECK(f(square(2, 9, 0.5), 256) == host::reference_form_factor(p, q));
}

TEST_CASE("a blocker does not hide the patches of its own surface") {
  host::Scene scene =
      scene_of({square(0, 1, 0), down(square(0, 1, 1))}, {square(0, 1, 0), square(-1, 2, 1)});
  scene.blockers[0].surface = 0;
  scene.blockers[1].surface = 1;
  CHECK(host::EmbreeVisibility(scene, 256).fraction(0, 1) == 1);
}

TEST_CASE("the Cornell box: what is seen, and that more rays change little") {
  const host::Scene scene = host::load_scene("cornell");
  const Eigen::MatrixXd f = host::exact_form_factors(scene, 0, 256);
  CHECK(f.minCoeff() >= 0);
  CHECK(f.rowwise().sum().maxCoeff() < 1.005);
  const std::vector<Vec3> few = host::exact_radiosity(scene, f);
  const std::vector<Vec3> many =
      host::exact_radiosity(scene, host::exact_form_factors(scene, 0, 1024));
  double difference = 0, sum = 0;
  for (std::size_t k = 0; k < few.size(); ++k) {
    if (scene.material_of(k).reflectance == Vec3(0)) continue;
    difference += glm::dot(few[k] - many[k], few[k] - many[k]);
    sum += glm::dot(many[k], many[k]);
  }
  CHECK(std::sqrt(difference / sum) < 5e-3);
  // Colour bleeds: the floor beside the red wall is redder than the one beside the green wall.
  const Vec3 red = many[21], green = many[27];
  CHECK(red.x / red.y > 1.2 * green.x / green.y);
}

TEST_CASE("repair makes rows sum to 1 and keeps exchanges symmetric") {
  const host::Scene scene = host::load_scene("cube7", {4, 0});
  constexpr unsigned seed = 7;
  CAPTURE(seed);
  std::mt19937 random(seed);
  Eigen::MatrixXd f = host::exact_form_factors(scene);
  for (Eigen::Index i = 0; i < f.rows();
       ++i)  // all areas are equal: symmetric noise keeps reciprocity
    for (Eigen::Index j = 0; j < i; ++j)
      f(i, j) = f(j, i) = f(j, i) * (0.8 + 0.4 * (double(random()) / 0x1p32));
  CHECK(worst_row(f) > 1e-3);
  const Eigen::MatrixXd g = host::repaired(f, host::symmetric_scale(scene, f));
  CHECK(worst_row(g) < 1e-12);
  CHECK((g - g.transpose()).cwiseAbs().maxCoeff() < 1e-16);
  f.row(3).setZero();
  CHECK_THROWS_WITH_AS(host::symmetric_scale(scene, f), doctest::Contains("patch 3"), host::Error);
}
