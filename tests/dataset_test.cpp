// Training data: what the engine computes is what the trainer sees, and general pairs are what they
// claim to be.
#include <doctest/doctest.h>

#include <set>

#include "form_factor/reference.hpp"
#include "hand_made_scene.hpp"
#include "network/engine_pair.hpp"
#include "network/evaluate.hpp"
#include "network/general_pairs.hpp"
#include "network/scene_dataset.hpp"
#include "network/train_net.hpp"

namespace {
constexpr std::uint64_t kSeed = 20240303;
}

TEST_CASE("the cube's pairs fall into few configurations, and their weights add up to all pairs") {
  const host::Scene scene = test::cube(7);
  const host::FixedScene fixed(scene);
  const host::SceneDataset data = host::scene_dataset(scene, fixed, 0.01);
  CHECK(data.pairs.size() == 36015);
  CHECK(data.configurations.size() <= 260);  // 224 up to rigid motion; rounding may split a few
  std::vector<double> row(data.patches, 0);
  std::size_t edges = 0;
  for (const host::ScenePair& pair : data.pairs) {
    row[pair.i] += pair.f_ij, row[pair.j] += pair.f_ji;
    edges += pair.kind == host::PairKind::edge;
  }
  for (const double sum : row) CHECK(sum == doctest::Approx(1).epsilon(1e-12));
  CHECK(edges == 84);

  const std::vector<char> most = host::hold_out(data, 0.2, kSeed);
  const auto held = std::count(most.begin(), most.end(), char{0});
  CHECK(held == std::lround(0.2 * double(most.size())));
  CHECK(most == host::hold_out(data, 0.2, kSeed));
  CHECK(most != host::hold_out(data, 0.2, kSeed + 1));
  const host::TrainingSet part = host::scene_training_set(data, most);
  CHECK(part.rows == 0);
  for (std::size_t k = 0; k < most.size(); ++k)
    CHECK((part.samples[k].weight > 0) == (most[k] != 0));
}

TEST_CASE("target and kernel of a sample give back the exact factor") {
  const host::Scene scene = test::cube(3);
  const host::FixedScene fixed(scene);
  const host::SceneDataset data = host::scene_dataset(scene, fixed, 0.01);
  const host::SceneMethod kernel = host::engine_method(fixed, nullptr);
  for (const host::ScenePair& pair : data.pairs) {
    const double target = data.configurations[pair.configuration].target;
    CHECK(kernel(pair.i, pair.j) * std::exp2(target) == doctest::Approx(pair.f_ij).epsilon(2e-5));
  }
}

TEST_CASE("families of random pairs touch as they say") {
  const auto share = [](host::PairFamily family, host::Contact wanted) {
    int found = 0;
    for (std::uint64_t k = 0; k < 200; ++k) {
      const host::PolygonPair pair = host::general_pair(family, kSeed, k);
      found += host::contact(pair.p, pair.q) == wanted;
    }
    return found;
  };
  INFO("seed ", kSeed);
  CHECK(share(host::PairFamily::edge, host::Contact::edge) == 200);
  CHECK(share(host::PairFamily::touching, host::Contact::edge) == 200);
  CHECK(share(host::PairFamily::corner, host::Contact::corner) == 200);
  CHECK(share(host::PairFamily::free, host::Contact::none) >= 195);
  CHECK(share(host::PairFamily::rotated, host::Contact::none) >= 195);
}

TEST_CASE(
    "training, validation and test pairs of a seed have none in common, nor with the next seed") {
  std::set<double> seen;
  for (const std::uint64_t seed : {1u, 2u})
    for (const auto use : {host::PairUse::training, host::PairUse::validation, host::PairUse::test})
      for (std::uint64_t k = 0; k < 50; ++k)
        CHECK(
            seen.insert(host::general_pair(host::PairFamily::free, host::general_seed(seed, use), k)
                            .p.outer[0]
                            .x)
                .second);
}

TEST_CASE(
    "a net trained for the cube: std <= 3e-5, worst row <= 0.3 %, held-out configurations beside "
    "it") {
  host::TrainRequest request;
  request.hidden = 4;
  request.seed = 5;
  request.effort = 0.5;
  const auto file = host::train_scene_net(test::cube(7), request);
  REQUIRE(file);
  const host::ErrorRow* wide = file->error("int16");
  REQUIRE(wide);
  REQUIRE(wide->rows);
  CHECK(wide->pairs == 72030);
  CHECK(wide->std <= 3e-5);
  CHECK(wide->rows->worst <= 0.003);
  REQUIRE(file->error("held_out"));
  CHECK(file->error("held_out")->std <= 3e-4);
  CHECK(file->error("int8")->std <= 3e-5);
  CHECK(wide->std < 0.1 * file->error("kernel")->std);
}

TEST_CASE("a general net, little trained, that never saw the cube beats the kernel there") {
  host::TrainRequest request;
  request.seed = 3;
  request.effort = 0.25;
  const auto file = host::train_general_net(request);
  REQUIRE(file);
  const host::Scene scene = test::cube(7);
  const host::FixedScene fixed(scene);
  const host::SceneDataset data = host::scene_dataset(scene, fixed, file->far_rho);
  const auto net =
      host::evaluate("net", data, host::engine_method(fixed, &file->quantised16.pod()));
  INFO(host::to_text(net));
  CHECK(net.front().std <= 6e-4);
}
