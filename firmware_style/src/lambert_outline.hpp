// lambert_outline.hpp -- a patch's vertices in the frame of a pair, cut by a plane as they pass by.
#pragma once
#include "urad/patch.hpp"
#include "urad/ratio.hpp"
#include "urad/vec.hpp"

namespace urad {

/// Scene units less `origin`, times 2^up.
struct Frame {
  urad_point origin;
  int up;

  urad_point place(const urad_point& x) const noexcept {
    const urad_point d = x - origin;
    const auto scaled = [this](int32_t a) {
      return up >= 0 ? a * (int32_t{1} << up) : round_shift(a, -up);
    };
    return {scaled(d.x), scaled(d.y), scaled(d.z)};
  }
};

struct Plane {
  urad_point normal_q30, on;  ///< `on` in the frame
};

/// Where the edge from `in` (height above the plane >= 0) to `out` (below 0) meets the plane.
inline urad_point crossing(const urad_point& in, int64_t above, const urad_point& out,
                           int64_t below) noexcept {
  const int64_t t_q30 = ratio_q(above, above - below, 30);
  const auto along = [=](int32_t a, int32_t b) {
    return int32_t(a + round_shift((int64_t{b} - a) * t_q30, 30));
  };
  return {along(in.x, out.x), along(in.y, out.y), along(in.z, out.z)};
}

/// The loop of a patch [Sutherland and Hodgman 1974: where a concave loop falls apart, edges along
/// the plane join the parts, there and back]. Short loops are kept, long ones are made anew on
/// every walk: the stack stays small.
class Outline {
 public:
  /// `plane` null: nothing is cut.
  Outline(const urad_scene& scene, const Patch& patch, const Frame& frame,
          const Plane* plane) noexcept
      : scene_(&scene), patch_(&patch), frame_(frame), plane_(plane) {
    walk([&](const urad_point& v) {
      if (count_ < kKept) kept_[count_] = v;
      ++count_;
    });
  }

  int count() const noexcept { return count_; }

  /// visit(vertex) in order.
  template <class Visit>
  void for_each_vertex(Visit visit) const noexcept {
    if (count_ > kKept) return walk(visit);
    for (int k = 0; k < count_; ++k) visit(kept_[k]);
  }

  /// visit(from, to) for every edge; the closing one comes last.
  template <class Visit>
  void for_each_edge(Visit visit) const noexcept {
    urad_point first{0, 0, 0}, last{0, 0, 0};
    bool started = false;
    for_each_vertex([&](const urad_point& v) {
      if (started) {
        visit(last, v);
      } else {
        first = v;
        started = true;
      }
      last = v;
    });
    if (started) visit(last, first);
  }

 private:
  static constexpr int kKept = 8;

  int64_t height(const urad_point& v) const noexcept {
    return plane_ ? dot(plane_->normal_q30, v - plane_->on) : 0;
  }

  template <class Visit>
  void walk(Visit visit) const noexcept {
    urad_point a = frame_.place(patch_vertex(*scene_, *patch_, uint16_t(patch_->vertex_count - 1)));
    int64_t above_a = height(a);
    for (uint16_t k = 0; k < patch_->vertex_count; ++k) {
      const urad_point b = frame_.place(patch_vertex(*scene_, *patch_, k));
      const int64_t above_b = height(b);
      if (above_a >= 0 && above_b < 0) visit(crossing(a, above_a, b, above_b));
      if (above_a < 0 && above_b >= 0) visit(crossing(b, above_b, a, above_a));
      if (above_b >= 0) visit(b);
      a = b;
      above_a = above_b;
    }
  }

  const urad_scene* scene_;
  const Patch* patch_;
  Frame frame_;
  const Plane* plane_;
  int count_ = 0;
  urad_point kept_[kKept];
};

}  // namespace urad
