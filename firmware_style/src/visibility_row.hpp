// visibility_row.hpp -- exported visibility, read along a row (scene.h, urad_visibility).
#pragma once
#include "urad/scene.h"

namespace urad {

/// The exported visibility of a scene, or null: rays are to be made.
inline const urad_visibility* visibility_of(const urad_scene& scene) noexcept {
  return scene.abi >= URAD_SCENE_ABI_SIGHT ? scene.visibility : nullptr;
}

/// What a shooter sees of patches in order. The table has passed scene_check().
class VisibilityRow {
 public:
  VisibilityRow(const urad_visibility& table, uint16_t shooter, uint16_t first) noexcept
      : bits_(table.bits), runs_(table.row[shooter] & URAD_VISIBILITY_RUNS), at_(first) {
    code_ = table.code + (table.row[shooter] & ~URAD_VISIBILITY_RUNS);
    if (!runs_) return;
    for (left_ = length(*code_); left_ <= at_; left_ = length(*code_)) {
      at_ = uint16_t(at_ - left_);
      ++code_;
    }
    left_ = uint16_t(left_ - at_);
  }

  /// Of the next patch, UQ16.16: code / (2^bits - 1).
  uint32_t next_uq16() noexcept {
    const uint32_t code = runs_ ? next_of_run() : next_of_bits();
    const uint32_t all = (1u << bits_) - 1;
    return code == all  ? 65536
           : bits_ == 1 ? 0
                        : (code * 69905u + 8) >> 4;  // 65536 / 15 = 69905 / 16
  }

  /// Patches that the run of this byte stands for.
  uint16_t length(uint8_t byte) const noexcept { return uint16_t((byte & (0xFF >> bits_)) + 1); }

 private:
  uint32_t next_of_run() noexcept {
    if (left_ == 0) left_ = length(*++code_);
    --left_;
    return uint32_t{*code_} >> (8 - bits_);
  }
  uint32_t next_of_bits() noexcept {
    const uint32_t bit = uint32_t{at_++} * bits_;
    return uint32_t{code_[bit >> 3]} >> (bit & 7) & ((1u << bits_) - 1);
  }

  const uint8_t* code_;
  uint8_t bits_;
  bool runs_;
  uint16_t at_, left_ = 0;
};

}  // namespace urad
