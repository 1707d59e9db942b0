#include "pose/pose_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <tuple>

#include "base/error.hpp"
#include "pose/pose.hpp"
#include "pose/pose_block.hpp"
#include "pose/pose_lattice.hpp"
#include "urad/patch.hpp"

namespace host {

namespace {

constexpr std::uint32_t kNoLight = 0;

/// What a blocker's plane and box see of two surfaces.
struct Extent {
  Vec3 low{1e300}, high{-1e300};
  void add(const Polygon& polygon) {
    for (const Vec3& x : polygon.outer) low = glm::min(low, x), high = glm::max(high, x);
  }
  bool meets(const Extent& other) const {
    return glm::all(glm::lessThanEqual(low, other.high)) &&
           glm::all(glm::lessThanEqual(other.low, high));
  }
};

class Builder {
 public:
  Builder(const Scene& scene, const FixedScene& fixed) : scene_(scene), pod_(fixed.pod()) {
    if (scene.patches.size() > kMostPosePatches)
      throw Error(
          fmt::format("{}: {} patches; a pose table is made for {} at most: net, hemicube or "
                      "a coarser mesh would do",
                      scene.name, scene.patches.size(), kMostPosePatches));
    for (std::uint16_t k = 0; k < pod_.patch_count; ++k) {
      const urad::Patch patch = urad::patch_at(pod_, k);
      Loop corners;
      for (std::uint16_t c = 0; c < patch.vertex_count; ++c)
        corners.push_back(to_vec(urad::patch_vertex(pod_, patch, c)));
      outline_.push_back(pose_outline(std::move(corners)));
    }
    for (std::uint16_t s = 0; s < pod_.surface_count; ++s) lattice_.emplace_back(pod_.surface[s]);
    for (const Blocker& blocker : scene.blockers) planes_.push_back(moments(blocker.polygon));
    layout_.patches = pod_.patch_count;
    layout_.surfaces = pod_.surface_count;
    layout_.factor.push_back({});
    layout_.block_of.assign(layout_.surfaces * layout_.surfaces, URAD_POSE_NO_BLOCK);
  }

  PoseLayout build() {
    for (std::size_t a = 0; a < layout_.surfaces; ++a) {
      for (std::size_t b = 0; b < layout_.surfaces; ++b) {
        if (a != b || !(pod_.surface[a].flags & URAD_SURFACE_PLANAR)) add_surfaces(a, b);
      }
    }
    layout_.factor_at = store_.ids();
    layout_.classes = classes_.size();
    return std::move(layout_);
  }

 private:
  bool occluded(std::size_t a, std::size_t b) const {
    Extent both;
    const auto each = [&](auto&& visit) {
      for (const std::size_t s : {a, b}) {
        const Surface& surface = scene_.surfaces[s];
        for (int k = 0; k < surface.patch_count; ++k)
          visit(scene_.patches[std::size_t(surface.first_patch + k)].polygon);
      }
    };
    if (scene_.blockers.empty()) return false;
    each([&](const Polygon& polygon) { both.add(polygon); });
    for (std::size_t k = 0; k < scene_.blockers.size(); ++k) {
      const Blocker& blocker = scene_.blockers[k];
      if (blocker.surface == int(a) || blocker.surface == int(b)) continue;
      Extent own;
      own.add(blocker.polygon);
      if (!own.meets(both)) continue;
      bool front = false, back = false;
      each([&](const Polygon& polygon) {
        for (const Vec3& x : polygon.outer) {
          const double height = glm::dot(planes_[k].normal, x - planes_[k].centroid);
          front = front || height > 0, back = back || height < 0;
        }
      });
      if (front && back) return true;
    }
    return false;
  }

  /// What the pair of these patches finds in the table.
  std::uint32_t id_of(std::size_t i, std::size_t j, bool occluded) {
    if (i == j || !faces(i, j) || !faces(j, i)) return kNoLight;
    if (occluded) {
      layout_.factor.push_back({std::uint16_t(i), std::uint16_t(j), true});
      return std::uint32_t(layout_.factor.size() - 1);
    }
    const auto known = seen_.find({std::min(i, j), std::max(i, j)});
    PoseClasses::Found found;
    if (known != seen_.end()) {
      found = known->second;
      if (j < i) found.swapped = !found.swapped;
    } else {
      found = classes_.find(outline_[i], outline_[j]);
      PoseClasses::Found stored = found;
      if (j < i) stored.swapped = !stored.swapped;
      seen_.emplace(std::pair(std::min(i, j), std::max(i, j)), stored);
    }
    meet(pose_difference(outline_[i], outline_[j], found.distance + along_grid_));
    return factor_of(found, i, j);
  }

  void meet(double difference) { layout_.difference = std::max(layout_.difference, difference); }

  /// One factor a class where both patches are equally large, else one for each direction.
  std::uint32_t factor_of(const PoseClasses::Found& found, std::size_t i, std::size_t j) {
    const auto index = std::uint32_t(layout_.factor.size());
    if (found.index == factors_of_class_.size()) {
      const double ratio = outline_[i].area / outline_[j].area;
      const bool equal = std::abs(ratio - 1) <= kEqualAreas;
      if (equal) meet(std::abs(ratio - 1));
      factors_of_class_.push_back({index, equal ? index : index + 1});
      layout_.factor.push_back({std::uint16_t(i), std::uint16_t(j), false});
      if (!equal) layout_.factor.push_back({std::uint16_t(j), std::uint16_t(i), false});
    }
    return factors_of_class_[found.index][found.swapped];
  }

  /// Some corner of j in front of i.
  bool faces(std::size_t i, std::size_t j) const {
    for (const Vec3& x : outline_[j].corner)
      if (glm::dot(outline_[i].normal, x - outline_[i].centre) > 0) return true;
    return false;
  }

  void add_surfaces(std::size_t a, std::size_t b) {
    const Lattice &from = lattice_[a], &to = lattice_[b];
    const bool hidden = occluded(a, b);
    Partner partner[2];
    if (!hidden) {
      const PoseOutline &p = outline_[std::size_t(from.first)],
                        &q = outline_[std::size_t(to.first)];
      const double limit = pose_tolerance(p, q);
      partner[0] = partner_of(from, to, 0, -1, limit);
      partner[1] = partner_of(from, to, 1, partner[0].axis, limit);
    }
    along_grid_ = partner[0].apart + partner[1].apart;
    PoseBox box;
    for (std::size_t k = 0; k < 2; ++k) {
      box.size[k] = std::size_t(to.count[k]);
      const int d = partner[k].axis;
      if (d >= 0) box.size[k] += std::size_t(from.count[d] - 1);
      if (partner[0].axis != int(k) && partner[1].axis != int(k))
        box.size[2 + k] = std::size_t(from.count[k]);
    }
    if (store_.ids().size() + box.count() > kMostPoseValues) refuse(hidden);
    fill(&box, from, to, partner, hidden);
    if (std::all_of(box.id.begin(), box.id.end(), [](std::uint32_t id) { return id == kNoLight; }))
      return;
    layout_.block_of[a * layout_.surfaces + b] =
        block_index(block_of(store_.add(box), from, partner));
  }

  void fill(PoseBox* box, const Lattice& from, const Lattice& to, const Partner* partner,
            bool hidden) {
    box->id.reserve(box->count());
    int position[4];
    const auto size = [&](int k) { return int(box->size[std::size_t(k)]); };
    for (position[3] = 0; position[3] < size(3); ++position[3])
      for (position[2] = 0; position[2] < size(2); ++position[2])
        for (position[1] = 0; position[1] < size(1); ++position[1])
          for (position[0] = 0; position[0] < size(0); ++position[0]) {
            int shooter[2] = {position[2], position[3]}, receiver[2];
            for (int k = 0; k < 2; ++k) {
              receiver[k] = position[k];
              const int d = partner[k].axis;
              if (d < 0) continue;
              // A pair with this position, the middle one of all that have it.
              const int shift =
                  partner[k].sign > 0 ? position[k] - (from.count[d] - 1) : position[k];
              const int low = partner[k].sign > 0 ? std::max(0, -shift)
                                                  : std::max(0, shift - (to.count[k] - 1));
              const int high = partner[k].sign > 0
                                   ? std::min(from.count[d] - 1, to.count[k] - 1 - shift)
                                   : std::min(from.count[d] - 1, shift);
              shooter[d] = (low + high) / 2;
              receiver[k] = shift + partner[k].sign * shooter[d];
            }
            box->id.push_back(id_of(from.patch(shooter), to.patch(receiver), hidden));
          }
  }

  static urad_pose_block block_of(const PosePlace& place, const Lattice& from,
                                  const Partner* partner) {
    urad_pose_block block{};
    block.first = place.first;
    for (int k = 0; k < 2; ++k) {
      urad_pose_axis& axis = block.axis[k];
      axis.stride = place.stride[k];
      block.mirror[k] = place.mirror[k];
      int offset = -place.centre[k];
      const int d = partner[k].axis;
      if (d >= 0) {
        (d == 0 ? axis.from_u : axis.from_v) = std::int8_t(-partner[k].sign);
        if (partner[k].sign > 0) offset += from.count[d] - 1;
      }
      axis.offset = std::int16_t(offset);
      block.from_stride[k] = place.stride[2 + k];
    }
    for (int k = 0; k < 2; ++k)
      if (partner[k].axis >= 0) block.from_stride[partner[k].axis] = 0;
    return block;
  }

  std::uint16_t block_index(const urad_pose_block& block) {
    static_assert(sizeof(urad_pose_block) == 32, "compared as bytes: no padding");
    for (std::size_t k = 0; k < layout_.block.size(); ++k) {
      if (std::memcmp(&layout_.block[k], &block, sizeof block) == 0) return std::uint16_t(k);
    }
    if (layout_.block.size() == URAD_POSE_NO_BLOCK) refuse(false);
    layout_.block.push_back(block);
    return std::uint16_t(layout_.block.size() - 1);
  }

  [[noreturn]] void refuse(bool hidden) const {
    throw Error(fmt::format(
        "{}: its pose table would hold more than {} factors: {}; net or hemicube would do, or a "
        "coarser mesh",
        scene_.name, kMostPoseValues,
        hidden ? "blockers stand between its surfaces, so that most pairs have one of their own"
               : "too few of its patches lie on grids that stand to each other alike"));
  }

  static constexpr double kEqualAreas = 1e-6;

  const Scene& scene_;
  const urad_scene& pod_;
  std::vector<PoseOutline> outline_;
  std::vector<Lattice> lattice_;
  std::vector<Moments> planes_;
  PoseClasses classes_;
  std::map<std::pair<std::size_t, std::size_t>, PoseClasses::Found> seen_;
  std::vector<std::array<std::uint32_t, 2>> factors_of_class_;
  PoseStore store_;
  double along_grid_ = 0;  // how far pairs at one position of a block are apart
  PoseLayout layout_;
};

}  // namespace

std::size_t PoseLayout::bytes() const {
  constexpr std::size_t kTableBytes = 24;  // pointers of 4 bytes
  return kTableBytes + sizeof(std::uint16_t) * block_of.size() +
         sizeof(urad_pose_block) * block.size() + sizeof(std::uint32_t) * values();
}

PoseLayout pose_layout(const Scene& scene, const FixedScene& fixed) {
  return Builder(scene, fixed).build();
}

}  // namespace host
