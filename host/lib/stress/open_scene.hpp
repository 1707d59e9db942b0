// A urad_scene that owns its tables, each in a block of exactly its length, so that whatever is
// read outside is found.
#pragma once
#include <cstdint>
#include <deque>
#include <vector>

#include "stress/choices.hpp"
#include "urad/scene.h"

namespace host {

class OpenScene {
 public:
  explicit OpenScene(const urad_scene& scene);
  OpenScene(const OpenScene&) = delete;
  OpenScene& operator=(const OpenScene&) = delete;

  /// Some bits, bytes or whole numbers of fields and tables changed; pointers left alone, tables
  /// made as long as the changed counts say.
  void mutate(Choices* choices);
  /// Anything that the check lets pass, and some that it does not: shapes, places and blockers
  /// without any relation to each other.
  void randomise(Choices* choices);

  /// Every bit of every table and field but pointers, in a fixed order.
  std::size_t bits();
  void flip(std::size_t bit);

  const urad_scene& pod() const { return scene_; }
  /// Changes when any byte of any table does.
  std::uint64_t digest() const;

 private:
  struct Bytes {
    void* data;
    std::size_t size;
  };
  std::vector<Bytes> tables();
  void link();

  urad_scene scene_{};
  std::vector<urad_surface> surface_;
  std::vector<urad_material> material_;
  std::vector<urad_blocker> blocker_;
  std::vector<urad_point> vertex_;
  std::vector<std::int32_t> scale_;
  std::vector<urad_bounds> bounds_;
  urad_visibility visibility_{};  ///< of no patches: none
  std::vector<std::uint32_t> row_;
  std::vector<std::uint8_t> code_;
  std::deque<std::vector<urad_grid>> grid_;        ///< by surface: one, or none
  std::deque<std::vector<urad_polygon>> polygon_;  ///< by surface
};

}  // namespace host
