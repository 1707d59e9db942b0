#include "pose/pose_block.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace host {

namespace {

using Sides = std::array<std::size_t, 4>;

constexpr std::size_t kMostTurned = std::size_t{1}
                                    << 16;  // larger boxes are only looked for as they are

Sides strides_of(const std::size_t* size) {
  return {1, size[0], size[0] * size[1], size[0] * size[1] * size[2]};
}

/// Calls visit(at) for the first entry of every line along `side`.
template <class Visit>
bool all_lines(const PoseBox& box, std::size_t side, const Visit& visit) {
  const Sides stride = strides_of(box.size);
  const std::size_t block = stride[side] * box.size[side];
  for (std::size_t outer = 0; outer < box.count(); outer += block) {
    for (std::size_t inner = 0; inner < stride[side]; ++inner) {
      if (!visit(outer + inner)) return false;
    }
  }
  return true;
}

/// True if position k and twice - k hold the same wherever both exist.
bool mirrors(const PoseBox& box, std::size_t side, std::size_t twice) {
  const std::size_t n = box.size[side], stride = strides_of(box.size)[side];
  return all_lines(box, side, [&](std::size_t at) {
    for (std::size_t k = 0; 2 * k < twice && k < n; ++k) {
      if (twice - k < n && box.id[at + k * stride] != box.id[at + (twice - k) * stride])
        return false;
    }
    return true;
  });
}

/// Twice the place of the mirror that leaves the fewest positions.
std::optional<std::size_t> mirror_of(const PoseBox& box, std::size_t side) {
  const std::size_t n = box.size[side];
  for (std::size_t off = 0; off + 1 < n; ++off) {  // at least two positions fall together
    for (const std::size_t twice : {n - 1 - off, n - 1 + off}) {
      if (mirrors(box, side, twice)) return twice;
    }
  }
  return std::nullopt;
}

/// The positions from the mirror on, the longer of its two sides.
PoseBox folded(const PoseBox& box, std::size_t side, std::size_t twice) {
  const std::size_t n = box.size[side], start = (twice + 1) / 2;  // first position not below it
  const std::size_t behind = twice / 2 + 1, before = n - start;
  PoseBox result = box;
  result.size[side] = std::max(behind, before);
  result.id.resize(result.count());
  const std::size_t to = strides_of(result.size)[side], from = strides_of(box.size)[side];
  std::vector<std::size_t> lines;
  all_lines(result, side, [&](std::size_t at) { return lines.push_back(at), true; });
  std::size_t line = 0;
  all_lines(box, side, [&](std::size_t at) {
    for (std::size_t k = 0; k < result.size[side]; ++k) {
      const std::size_t position = start + k < n ? start + k : twice - start - k;
      result.id[lines[line] + k * to] = box.id[at + position * from];
    }
    return ++line, true;
  });
  return result;
}

/// One way of looking at a box: side k of the view is side order[k] of the box, or runs backwards.
struct Turn {
  std::array<std::size_t, 4> order{0, 1, 2, 3};
  unsigned backwards = 0;  // bit k: side k of the box
};

std::vector<Turn> turns(const PoseBox& box) {
  std::vector<Turn> result;
  Turn turn;
  do {
    // Sides of length 1 stay in order: turning them changes nothing.
    std::size_t last = 0;
    bool useful = true;
    for (const std::size_t side : turn.order) {
      if (box.size[side] != 1) continue;
      useful = useful && side >= last;
      last = side;
    }
    for (turn.backwards = 0; useful && turn.backwards < 16; ++turn.backwards) {
      bool flips = true;
      for (std::size_t k = 0; k < 4; ++k)
        flips = flips && !((turn.backwards >> k & 1) && box.size[k] == 1);
      if (flips) result.push_back(turn);
    }
  } while (std::next_permutation(turn.order.begin(), turn.order.end()));
  return result;
}

/// Where the entries of `box` lie when its view fills a box of `size` at 0; none if it does not
/// fit.
std::optional<PosePlace> place_of(const PoseBox& box, const Turn& turn, const std::size_t* size) {
  PosePlace place;
  const Sides stride = strides_of(size);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t side = turn.order[k];
    if (box.size[side] != size[k]) return std::nullopt;
    const bool backwards = turn.backwards >> side & 1;
    place.stride[side] = std::int32_t(stride[k]) * (backwards ? -1 : 1);
    if (backwards) place.first += std::uint32_t(stride[k] * (size[k] - 1));
  }
  return place;
}

bool same(const PoseBox& box, const PosePlace& place, const std::uint32_t* ids) {
  std::size_t at = 0;
  std::int64_t k[4];
  for (k[3] = 0; k[3] < std::int64_t(box.size[3]); ++k[3])
    for (k[2] = 0; k[2] < std::int64_t(box.size[2]); ++k[2])
      for (k[1] = 0; k[1] < std::int64_t(box.size[1]); ++k[1])
        for (k[0] = 0; k[0] < std::int64_t(box.size[0]); ++k[0], ++at) {
          std::int64_t there = place.first;
          for (int d = 0; d < 4; ++d) there += k[d] * place.stride[d];
          if (box.id[at] != ids[there]) return false;
        }
  return true;
}

}  // namespace

PosePlace PoseStore::add(const PoseBox& whole) {
  PoseBox box = whole;
  std::uint8_t mirror[2] = {URAD_POSE_PLAIN, URAD_POSE_PLAIN};
  int centre[2] = {0, 0};
  for (std::size_t side = 0; side < 2; ++side) {
    const auto twice = mirror_of(box, side);
    if (!twice) continue;
    mirror[side] = *twice % 2 ? URAD_POSE_ABOUT_HALF : URAD_POSE_ABOUT_0;
    centre[side] = int((*twice + 1) / 2);
    box = folded(box, side, *twice);
  }

  std::optional<PosePlace> place;
  const std::vector<Turn> views = box.count() <= kMostTurned ? turns(box) : std::vector<Turn>{{}};
  for (const Kept& kept : kept_) {
    if (box.count() != kept.size[0] * kept.size[1] * kept.size[2] * kept.size[3]) continue;
    for (const Turn& turn : views) {
      place = place_of(box, turn, kept.size);
      if (place && same(box, *place, ids_.data() + kept.first)) {
        place->first += std::uint32_t(kept.first);
        break;
      }
      place.reset();
    }
    if (place) break;
  }
  if (!place) {
    place = place_of(box, {}, box.size);
    place->first += std::uint32_t(ids_.size());
    kept_.push_back({{box.size[0], box.size[1], box.size[2], box.size[3]}, ids_.size()});
    ids_.insert(ids_.end(), box.id.begin(), box.id.end());
  }
  for (int k = 0; k < 2; ++k) place->mirror[k] = mirror[k], place->centre[k] = centre[k];
  return *place;
}

}  // namespace host
