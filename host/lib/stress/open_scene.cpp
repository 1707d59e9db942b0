#include "stress/open_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>

namespace host {
namespace {

constexpr std::uint32_t kMostEntries = 300;  // of tables that a changed count makes longer

template <class T>
std::vector<T> copied(const T* from, std::size_t count) {
  return from ? std::vector<T>(from, from + count) : std::vector<T>{};
}

/// As long as `count` says, new entries like the first; a block of exactly that length.
template <class T>
void fit(std::vector<T>* items, std::size_t count) {
  std::vector<T> exact(count, items->empty() ? T{} : items->front());
  std::copy_n(items->begin(), std::min(count, items->size()), exact.begin());
  items->swap(exact);
}

constexpr std::uint32_t kWords[] = {0,          1,          2,          3,          0xFFFF,
                                    0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0x20000000, 0xE0000000,
                                    0x40000000, 0xC0000000, 0x00FF00FF, 0x7FFF8000};

std::int32_t coordinate(Choices* choices) {
  const auto wide = std::int32_t(choices->word()) >> 2;
  return wide >> choices->below(30);
}

urad_point place(Choices* choices) {
  return {coordinate(choices), coordinate(choices), coordinate(choices)};
}

urad_point unit(Choices* choices) {
  const double z = choices->half() / 32767.5 - 1, angle = choices->half() / 65535.0 * 6.283185307;
  const double r = std::sqrt(std::max(0.0, 1 - z * z));
  const auto q30 = [](double x) { return std::int32_t(std::lround(x * 0x1p30)); };
  if (choices->below(3) == 0) return {0, 0, choices->yes() ? 1 << 30 : -(1 << 30)};
  return {q30(r * std::cos(angle)), q30(r * std::sin(angle)), q30(z)};
}

urad_shape shape(Choices* choices) {
  urad_shape s{};
  s.normal_q30 = unit(choices);
  const std::int32_t spread = std::int32_t(choices->word()) >> 1;  // +- 64 in Q7.24
  s.log2_area_q24 = choices->yes() ? spread : (30 + std::int32_t(choices->below(30))) << 24;
  s.log2_spread_q24 =
      choices->yes() ? std::int32_t(choices->word()) >> 1 : s.log2_area_q24 - (2 << 24);
  s.spread_q15[0] = std::int16_t(choices->below(32769) >> (choices->below(4)));
  s.spread_q15[1] = std::int16_t(choices->below(std::uint32_t(32769 - s.spread_q15[0])));
  s.spread_q15[2] = std::int16_t(std::min(32767, 32768 - s.spread_q15[0] - s.spread_q15[1]));
  const bool moments = choices->below(4) > 0;  // or what no patch has
  constexpr int kPlaces[3][2] = {{0, 1}, {0, 2}, {1, 2}};
  for (int k = 3; k < 6; ++k) {
    const std::int16_t any = std::int16_t(choices->half());
    const double most =
        std::sqrt(double(s.spread_q15[kPlaces[k - 3][0]]) * s.spread_q15[kPlaces[k - 3][1]]);
    s.spread_q15[k] = moments ? std::int16_t(any * 0x1p-15 * most) : any;
  }
  s.fill_uq15 = std::uint16_t(choices->below(32769));
  return s;
}

}  // namespace

OpenScene::OpenScene(const urad_scene& scene)
    : scene_(scene),
      surface_(copied(scene.surface, scene.surface_count)),
      material_(copied(scene.material, scene.material_count)),
      blocker_(copied(scene.blocker, scene.blocker_count)),
      vertex_(copied(scene.vertex, scene.vertex_count)),
      scale_(copied(scene.log2_scale_q24, scene.patch_count)),
      bounds_(copied(scene.bounds, scene.bounds_count)) {
  if (const urad_visibility* visibility = scene.visibility) {
    visibility_ = *visibility;
    row_ = copied(visibility->row, visibility->patch_count);
    code_ = copied(visibility->code, visibility->byte_count);
  }
  for (const urad_surface& surface : surface_) {
    grid_.push_back(copied(surface.grid, 1));
    polygon_.push_back(copied(surface.polygon, surface.patch_count));
  }
  link();
}

void OpenScene::link() {
  for (std::size_t k = 0; k < surface_.size(); ++k) {
    surface_[k].grid = grid_[k].empty() ? nullptr : grid_[k].data();
    surface_[k].polygon = polygon_[k].empty() ? nullptr : polygon_[k].data();
  }
  scene_.surface = surface_.data();
  scene_.material = material_.data();
  scene_.blocker = blocker_.empty() ? nullptr : blocker_.data();
  scene_.vertex = vertex_.empty() ? nullptr : vertex_.data();
  scene_.log2_scale_q24 = scale_.empty() ? nullptr : scale_.data();
  scene_.bounds = bounds_.empty() ? nullptr : bounds_.data();
  visibility_.row = row_.data();
  visibility_.code = code_.data();
  scene_.visibility = code_.empty() ? nullptr : &visibility_;
}

std::vector<OpenScene::Bytes> OpenScene::tables() {
  const auto all = [](auto& items) { return Bytes{items.data(), items.size() * sizeof(items[0])}; };
  std::vector<Bytes> result{{&scene_, offsetof(urad_scene, surface)},
                            {&scene_.log2_power_q24, sizeof scene_.log2_power_q24},
                            all(material_),
                            all(blocker_),
                            all(vertex_),
                            all(scale_),
                            all(bounds_),
                            all(row_),
                            all(code_)};
  if (scene_.abi == URAD_SCENE_ABI_SIGHT) {
    result.push_back({&scene_.bounds_count, 2 * sizeof scene_.bounds_count});
    if (!code_.empty()) result.push_back({&visibility_, offsetof(urad_visibility, row)});
  }
  for (urad_surface& surface : surface_) result.push_back({&surface, offsetof(urad_surface, grid)});
  for (auto& grid : grid_) result.push_back(all(grid));
  for (auto& polygon : polygon_) result.push_back(all(polygon));
  std::erase_if(result, [](const Bytes& bytes) { return bytes.size == 0; });
  return result;
}

std::size_t OpenScene::bits() {
  std::size_t sum = 0;
  for (const Bytes& table : tables()) sum += 8 * table.size;
  return sum;
}

void OpenScene::flip(std::size_t bit) {
  for (const Bytes& table : tables()) {
    if (bit < 8 * table.size) {
      static_cast<std::uint8_t*>(table.data)[bit / 8] ^= std::uint8_t(1u << bit % 8);
      return;
    }
    bit -= 8 * table.size;
  }
}

void OpenScene::mutate(Choices* choices) {
  for (std::uint32_t k = 1 + choices->below(6); k > 0; --k) {
    const std::vector<Bytes> all = tables();
    const Bytes& table = all[choices->below(std::uint32_t(all.size()))];
    auto* const bytes = static_cast<std::uint8_t*>(table.data);
    const std::size_t at = choices->below(std::uint32_t(std::min<std::size_t>(table.size, 65536)));
    if (choices->yes()) {
      bytes[at] ^= std::uint8_t(1u << choices->below(8));
    } else {
      const std::size_t width = choices->yes() ? 2 : 4, from = at - at % width;
      const std::uint32_t word =
          choices->yes() ? kWords[choices->below(std::size(kWords))] : choices->word();
      std::memcpy(bytes + from, &word, std::min(width, table.size - from));
    }
  }
  scene_.surface_count = std::uint16_t(scene_.surface_count % kMostEntries);
  scene_.material_count = std::uint16_t(scene_.material_count % kMostEntries);
  scene_.blocker_count = std::uint16_t(scene_.blocker_count % kMostEntries);
  scene_.vertex_count %= 4 * kMostEntries;
  fit(&surface_, scene_.surface_count);
  fit(&material_, scene_.material_count);
  fit(&blocker_, scene_.blocker_count);
  fit(&vertex_, scene_.vertex_count);
  if (!scale_.empty()) fit(&scale_, scene_.patch_count);
  scene_.bounds_count = std::uint16_t(scene_.bounds_count % kMostEntries);
  if (!bounds_.empty()) fit(&bounds_, scene_.bounds_count);
  visibility_.byte_count %= 1u << 20;
  if (!code_.empty()) {
    fit(&row_, visibility_.patch_count);
    fit(&code_, visibility_.byte_count);
  }
  grid_.resize(surface_.size(), grid_.front());
  polygon_.resize(surface_.size(), polygon_.front());
  for (std::size_t s = 0; s < surface_.size(); ++s)
    if (!polygon_[s].empty()) fit(&polygon_[s], std::max<std::size_t>(1, surface_[s].patch_count));
  link();
}

void OpenScene::randomise(Choices* choices) {
  vertex_.assign(8 + choices->below(64), {});
  for (urad_point& x : vertex_) x = place(choices);
  const auto loop = [&](std::uint32_t* first, std::uint16_t* count) {
    *count = std::uint16_t(
        3 + choices->below(std::uint32_t(std::min<std::size_t>(vertex_.size(), 64) - 2)));
    *first = choices->below(std::uint32_t(vertex_.size()) - *count + 1);
  };
  surface_.clear(), grid_.clear(), polygon_.clear();
  std::uint16_t patches = 0;
  for (std::uint32_t s = 1 + choices->below(5); s > 0; --s) {
    urad_surface surface{patches,
                         0,
                         std::uint16_t(choices->below(std::uint32_t(material_.size()))),
                         std::uint16_t(choices->below(2)),
                         nullptr,
                         nullptr};
    if (choices->yes()) {
      urad_grid grid{place(choices),
                     place(choices),
                     place(choices),
                     std::uint16_t(1 + choices->below(4)),
                     std::uint16_t(1 + choices->below(4)),
                     shape(choices)};
      surface.patch_count = std::uint16_t(grid.count_u * grid.count_v);
      grid_.push_back({grid}), polygon_.emplace_back();
    } else {
      polygon_.emplace_back(), grid_.emplace_back();
      for (std::uint32_t k = 1 + choices->below(4); k > 0; --k) {
        urad_polygon polygon{shape(choices), place(choices), 0, 0, 0};
        loop(&polygon.first_vertex, &polygon.vertex_count);
        polygon_.back().push_back(polygon);
      }
      surface.patch_count = std::uint16_t(polygon_.back().size());
    }
    patches = std::uint16_t(patches + surface.patch_count);
    surface_.push_back(surface);
  }
  blocker_.clear();
  for (std::uint32_t k = choices->below(4); k > 0; --k) {
    urad_blocker blocker{unit(choices), place(choices), place(choices), 0, 0, 0xFFFF};
    loop(&blocker.first_vertex, &blocker.vertex_count);
    if (choices->yes())
      blocker.surface = std::uint16_t(choices->below(std::uint32_t(surface_.size())));
    blocker_.push_back(blocker);
  }
  for (urad_material& material : material_)
    for (int c = 0; c < 3; ++c) {
      material.reflectance_uq15[c] = std::uint16_t(choices->below(32769));
      material.exitance[c] = std::int32_t(choices->word() >> (2 + choices->below(30)));
    }
  scale_.clear();
  if (choices->yes())
    for (std::uint16_t k = 0; k < patches; ++k)
      scale_.push_back(std::int32_t(choices->word()) >> (4 + choices->below(8)));
  scene_.abi = URAD_SCENE_ABI;
  scene_.flags = std::uint16_t(choices->below(4));
  scene_.patch_count = patches;
  scene_.surface_count = std::uint16_t(surface_.size());
  scene_.blocker_count = std::uint16_t(blocker_.size());
  scene_.vertex_count = std::uint32_t(vertex_.size());
  scene_.log2_power_q24 = std::int32_t(choices->word()) >> 1;
  link();
}

std::uint64_t OpenScene::digest() const {
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (const Bytes& table : const_cast<OpenScene*>(this)->tables())
    for (std::size_t k = 0; k < table.size; ++k)
      hash = (hash ^ static_cast<const std::uint8_t*>(table.data)[k]) * 1099511628211u;
  return hash;
}

}  // namespace host
