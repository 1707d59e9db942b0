// The report's hemicube: its cells, and the two resolutions that its printed numbers point to.
#include <doctest/doctest.h>

#include <cmath>

#include "base/error.hpp"
#include "form_factor/reference.hpp"
#include "legacy/centre_hemicube.hpp"
#include "scene/builtin.hpp"
#include "solve/exact.hpp"

TEST_CASE("cells sum to 1 as the resolution grows, and every row of a closed scene with them") {
  const host::Scene scene = host::load_scene("cube7");
  double last = 1;
  for (const int resolution : {8, 16, 32}) {
    host::HemicubeCount count;
    const Eigen::MatrixXd f = host::centre_hemicube(scene, resolution, 0, &count);
    const double excess = count.row_of_cells - 1;
    CHECK(excess * resolution * resolution == doctest::Approx(0.54).epsilon(0.05));
    CHECK(excess < last / 3.5);
    last = excess;
    CHECK(count.rays == 294 * std::uint64_t(host::hemicube_cells(resolution)));
    CHECK(count.sums < count.rays);
    for (Eigen::Index i = 0; i < f.rows(); ++i)
      CHECK(f.row(i).sum() == doctest::Approx(count.row_of_cells).epsilon(1e-9));
  }
}

TEST_CASE("8 cells a side have the printed deviation, and far from the printed row sum") {
  const host::Scene scene = host::load_scene("cube7");
  host::HemicubeCount count;
  const Eigen::MatrixXd off =
      host::centre_hemicube(scene, 8, 0, &count) - host::exact_form_factors(scene, 0, 1);
  const double std = std::sqrt((off.array() - off.mean()).square().mean());
  CHECK(std == doctest::Approx(0.0043).epsilon(0.05));
  CHECK(off.mean() > 4 * 6.0358e-6);
}

TEST_CASE("odd resolutions are refused") {
  const host::Scene scene = host::load_scene("cube7");
  host::HemicubeCount count;
  CHECK_THROWS_AS(host::centre_hemicube(scene, 7, 0, &count), host::Error);
  CHECK_THROWS_AS(host::centre_hemicube(scene, 0, 0, &count), host::Error);
}
