#include "stress/scene_entries.hpp"

#include <algorithm>
#include <array>

#include "scene/builtin.hpp"
#include "scene/fixed_scene.hpp"
#include "stress/open_scene.hpp"
#include "urad/hemicube_table.hpp"

namespace host {
namespace {

constexpr std::uint32_t kCanary = 0xC0DEC0DEu;
constexpr std::size_t kFence = 8;

/// Memory as an entry asked for it, between two fences.
class Fenced {
 public:
  explicit Fenced(std::size_t bytes) : words_((bytes + 7) / 8 * 2 + 2 * kFence, kCanary) {}
  void* data() { return words_.data() + kFence; }
  bool whole() const {
    const auto canary = [](std::uint32_t word) { return word == kCanary; };
    return std::all_of(words_.begin(), words_.begin() + kFence, canary) &&
           std::all_of(words_.end() - kFence, words_.end(), canary);
  }
  bool untouched() const {
    return std::all_of(words_.begin(), words_.end(),
                       [](std::uint32_t word) { return word == kCanary; });
  }

 private:
  std::vector<std::uint32_t> words_;
};

struct HemicubeArrays {
  std::vector<std::uint32_t> top, side;
  urad_hemicube_table table;

  explicit HemicubeArrays(int resolution)
      : top(std::size_t(resolution / 2) * std::size_t(resolution / 2)), side(top.size()) {
    std::vector<double> scratch(2 * top.size());
    urad::fill_hemicube_cells(resolution, scratch.data(), top.data(), side.data());
    table = {std::uint16_t(resolution), top.data(), side.data()};
  }
};

const urad_hemicube_table& hemicube_table(bool fine) {
  static const HemicubeArrays coarse(16), finer(32);
  return fine ? finer.table : coarse.table;
}

const std::vector<FixedScene>& good_scenes() {
  static const std::vector<FixedScene> scenes = [] {
    std::vector<FixedScene> all;
    all.emplace_back(load_scene("cube7", {1, 0}));
    all.emplace_back(load_scene("cornell", {1, 0}));
    all.push_back(
        FixedScene::of_polygons({{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.4, 0.5, 0}, {0, 1, 0}}, {}},
                                 {{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}}, {}},
                                 {{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, {}}},
                                {{{{0.2, 0.2, 0.5}, {0.8, 0.2, 0.5}, {0.5, 0.8, 0.5}}, {}}}));
    all.back().set_scale({1, 0.5, 2});
    return all;
  }();
  return scenes;
}

bool known(urad_status status) { return status >= URAD_OK && status <= URAD_DIVERGES; }

/// One row of a source, all runs of it.
void ask_row(const urad_scene& scene, const urad_source& source, std::uint16_t shooter,
             Findings* findings) {
  for (std::uint16_t s = 0; s < scene.surface_count; ++s) {
    const urad_surface& surface = scene.surface[s];
    Fenced row(std::size_t{4} * surface.patch_count);
    const urad_status status =
        source.fill(source.context, shooter, s, surface.first_patch, surface.patch_count,
                    static_cast<std::uint32_t*>(row.data()));
    findings->expect("a row is filled", status == URAD_OK);
    findings->expect("nothing is written outside", row.whole());
  }
  std::uint32_t untouched = kCanary;
  const auto refuses = [&](std::uint16_t i, std::uint16_t surface, std::uint16_t first,
                           std::uint16_t count) {
    return source.fill(source.context, i, surface, first, count, &untouched) == URAD_BAD_ARGUMENT &&
           untouched == kCanary;
  };
  findings->expect("an index out of range is refused",
                   refuses(scene.patch_count, 0, 0, 1) && refuses(0, scene.surface_count, 0, 1) &&
                       refuses(0, 0, std::uint16_t(scene.surface[0].patch_count), 1) &&
                       refuses(0xFFFF, 0xFFFF, 0xFFFF, 0xFFFF));
}

void solve(const urad_scene& scene, const urad_source& source, Choices* choices,
           Findings* findings) {
  const auto run = std::uint16_t(1 + choices->below(urad_longest_run(&scene)));
  const std::size_t bytes = URAD_RADIOSITY_BYTES(scene.patch_count, run);
  Fenced memory(bytes);
  urad_radiosity state;
  const unsigned flags = choices->below(32);
  const urad_status status =
      urad_radiosity_init(&state, &scene, &source, flags, run, memory.data(), bytes);
  findings->expect("a known status", known(status));
  if (status != URAD_OK) return findings->expect("nothing is written", memory.untouched());
  bool ledger = true, statuses = true;
  for (int shot = 0; shot < 24 && !urad_radiosity_done(&state, URAD_PERCENT); ++shot) {
    statuses = statuses && known(urad_radiosity_step(&state));
    ledger = ledger && urad_radiosity_audit(&state, nullptr);
  }
  std::int32_t exitance = 0;
  for (std::uint16_t k = 0; k < scene.patch_count; ++k)
    for (unsigned c = 0; c < 3; ++c)
      statuses = statuses && urad_radiosity_get(&state, k, c, &exitance) == URAD_OK &&
                 urad_radiosity_display(&state, k, c, &exitance) == URAD_OK;
  static_cast<void>(urad_radiosity_error_uq32(&state));
  findings->expect("a known status", statuses);
  findings->expect("ledger exact at every shot", ledger);
  findings->expect("nothing is written outside", memory.whole());
}

void by_pairs(const urad_scene& scene, const urad_net* net, Choices* choices, Findings* findings) {
  urad_counters counters{};
  const unsigned kernel = choices->below(2);
  const auto rays = std::uint16_t(choices->below(3) * 5);
  for (int k = 0; k < 4; ++k) {
    const auto from = std::uint16_t(choices->below(scene.patch_count));
    const auto to = std::uint16_t(choices->below(scene.patch_count));
    std::uint32_t f_uq32 = 0;
    findings->expect("a factor", urad_form_factor(&scene, from, to, kernel, net, rays, &f_uq32,
                                                  &counters) == URAD_OK);
  }
  Fenced memory(urad_pair_source_bytes());
  urad_source source;
  if (urad_pair_source_init(&source, &scene, kernel, net, rays, &counters, memory.data(),
                            urad_pair_source_bytes()) != URAD_OK)
    return findings->expect("a pair source", false);
  ask_row(scene, source, std::uint16_t(choices->below(scene.patch_count)), findings);
  solve(scene, source, choices, findings);
  findings->expect("nothing is written outside", memory.whole());
}

void by_hemicube(const urad_scene& scene, const urad_net* net, Choices* choices,
                 Findings* findings) {
  urad_counters counters{};
  const urad_hemicube_table& table = hemicube_table(choices->yes());
  const bool convex = scene.flags & URAD_SCENE_CONVEX;
  const auto rows =
      std::uint16_t(convex && choices->yes() ? 0 : 1 + choices->below(table.resolution));
  const unsigned flags = choices->below(4);
  const std::size_t bytes = urad_hemicube_source_bytes(&scene, table.resolution, rows, flags);
  Fenced memory(bytes), hybrid_memory(urad_hybrid_source_bytes());
  urad_source source, hybrid;
  const urad_status status = urad_hemicube_source_init(&source, &scene, &table, rows, flags,
                                                       &counters, memory.data(), bytes);
  findings->expect("a hemicube source", status == URAD_OK);
  if (status != URAD_OK) return;
  ask_row(scene, source, std::uint16_t(choices->below(scene.patch_count)), findings);
  if (choices->yes()) solve(scene, source, choices, findings);
  const bool fits = convex || (flags & URAD_HEMICUBE_COVERAGE);
  const std::uint32_t near = choices->yes() ? choices->half() : 0;
  const urad_status made =
      urad_hybrid_source_init(&hybrid, &source, URAD_KERNEL_MOMENT, net, 4, near,
                              hybrid_memory.data(), urad_hybrid_source_bytes());
  findings->expect("a hybrid source where the hemicube fits", (made == URAD_OK) == fits);
  if (made == URAD_OK) {
    ask_row(scene, hybrid, std::uint16_t(choices->below(scene.patch_count)), findings);
    if (choices->yes()) solve(scene, hybrid, choices, findings);
  }
  findings->expect("nothing is written outside", memory.whole() && hybrid_memory.whole());
}

}  // namespace

void attack_engine(Choices choices, const urad_net& net, Findings* findings) {
  const std::vector<FixedScene>& good = good_scenes();
  OpenScene scene(good[choices.below(std::uint32_t(good.size()))].pod());
  if (choices.yes())
    scene.mutate(&choices);
  else
    scene.randomise(&choices);
  const std::uint64_t before = scene.digest();
  const urad_status status = urad_scene_check(&scene.pod());
  findings->expect("accepted or refused", status == URAD_OK || status == URAD_BAD_SCENE);
  findings->measure("scenes that pass the check", status == URAD_OK);
  if (status == URAD_OK) {
    const urad_net* const used = choices.yes() ? &net : nullptr;
    by_pairs(scene.pod(), used, &choices, findings);
    by_hemicube(scene.pod(), used, &choices, findings);
  }
  findings->expect("the scene is not written", scene.digest() == before);
}

void attack_arguments(Choices choices, const urad_net& net, Findings* findings) {
  const std::vector<FixedScene>& good = good_scenes();
  const urad_scene& scene = good[choices.below(std::uint32_t(good.size()))].pod();
  const auto n = scene.patch_count;
  const urad_hemicube_table& table = hemicube_table(false);
  urad_counters counters{};
  std::uint32_t f_uq32 = kCanary;
  Fenced memory(1 << 16);
  void* const at = memory.data();
  urad_source source{nullptr, nullptr};
  urad_radiosity state{};
  // Each of them is wrong in one way, whatever the bytes choose for the rest.
  const auto from = std::uint16_t(choices.below(n)), high = std::uint16_t(n + choices.below(60000));
  const auto rays = std::uint16_t(choices.below(URAD_RAYS_MAX + 1));
  const std::size_t too_few = choices.below(64);
  const urad_status refused[] = {
      urad_form_factor(nullptr, from, from, 0, &net, rays, &f_uq32, &counters),
      urad_form_factor(&scene, high, from, 0, &net, rays, &f_uq32, &counters),
      urad_form_factor(&scene, from, high, 0, &net, rays, &f_uq32, &counters),
      urad_form_factor(&scene, from, from, 2 + choices.byte(), &net, rays, &f_uq32, &counters),
      urad_form_factor(&scene, from, from, 0, &net,
                       std::uint16_t(URAD_RAYS_MAX + 1 + choices.byte()), &f_uq32, &counters),
      urad_form_factor(&scene, from, from, 0, &net, rays, nullptr, &counters),
      urad_pair_source_init(nullptr, &scene, 0, &net, rays, &counters, at, 4096),
      urad_pair_source_init(&source, nullptr, 0, &net, rays, &counters, at, 4096),
      urad_pair_source_init(&source, &scene, 0, &net, rays, nullptr, at, 4096),
      urad_pair_source_init(&source, &scene, 0, &net, rays, &counters, nullptr, 4096),
      urad_pair_source_init(&source, &scene, 0, &net, rays, &counters, at,
                            std::min(too_few, urad_pair_source_bytes() - 1)),
      urad_pair_source_init(&source, &scene, 0, &net, rays, &counters,
                            static_cast<char*>(at) + 1 + choices.below(3), 4096),
      urad_hemicube_source_init(&source, &scene, &table, std::uint16_t(17 + choices.byte()), 0,
                                &counters, at, 1 << 16),
      urad_hemicube_source_init(&source, &scene, &table, 16, 16 + choices.byte(), &counters, at,
                                1 << 16),
      urad_hemicube_source_init(&source, &scene, &table, 16, 0, &counters, at, too_few),
      urad_hemicube_source_init(&source, &scene, nullptr, 16, 0, &counters, at, 1 << 16),
      urad_hybrid_source_init(&source, &source, 0, &net, 4, 0, at, 4096),
      urad_radiosity_init(&state, &scene, nullptr, 0, 1, at, 1 << 16),
      urad_radiosity_init(&state, &scene, &source, 32 + choices.byte() * 32, 1, at, 1 << 16),
      urad_radiosity_init(&state, &scene, &source, 0, 0, at, 1 << 16),
      urad_radiosity_step(nullptr),
      urad_radiosity_get(nullptr, 0, 0, nullptr)};
  findings->expect("every wrong argument is refused",
                   std::all_of(std::begin(refused), std::end(refused), [](urad_status status) {
                     return status == URAD_BAD_ARGUMENT || status == URAD_OUT_OF_MEMORY;
                   }));
  findings->expect("nothing is written", memory.untouched() && f_uq32 == kCanary &&
                                             source.fill == nullptr && counters.evaluated == 0);
  findings->expect("null is done, without error, without balance",
                   urad_radiosity_done(nullptr, 0) && urad_radiosity_error_uq32(nullptr) == 0 &&
                       !urad_radiosity_audit(nullptr, nullptr) && urad_longest_run(nullptr) == 0 &&
                       urad_hemicube_source_bytes(nullptr, 16, 16, 0) == 0);
}

void attack_bits(Choices choices, Findings* findings) {
  const std::vector<FixedScene>& good = good_scenes();
  OpenScene scene(good[choices.below(std::uint32_t(good.size()))].pod());
  std::uint32_t crc32[2];
  urad_scene_crc32(&scene.pod(), crc32);
  findings->expect("the scene passes", urad_scene_verify(&scene.pod(), crc32) == URAD_OK);
  constexpr int kBits = 64;
  std::size_t missed = 0;
  for (int k = 0; k < kBits; ++k) {
    const std::size_t bit = choices.word() % scene.bits();
    scene.flip(bit);
    missed += urad_scene_verify(&scene.pod(), crc32) == URAD_OK;
    scene.flip(bit);
  }
  findings->measure("single-bit faults that pass", double(missed), 0);
}

}  // namespace host
