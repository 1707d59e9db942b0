#include "plan/chip_bytes.hpp"

#include <algorithm>
#include <cstdint>

#include "urad/hemicube.hpp"
#include "urad/radiosity.hpp"

namespace host {

std::size_t most_vertices(const urad_scene& scene) {
  std::size_t most = 4;
  for (std::size_t s = 0; s < scene.surface_count; ++s) {
    const urad_surface& surface = scene.surface[s];
    for (std::size_t k = 0; surface.polygon && k < surface.patch_count; ++k)
      most = std::max<std::size_t>(most, surface.polygon[k].vertex_count);
  }
  for (std::size_t k = 0; k < scene.blocker_count; ++k)
    most = std::max<std::size_t>(most, scene.blocker[k].vertex_count);
  return most;
}

std::size_t solver_ram(const urad_scene& scene) {
  return kStateBytes + kCountersBytes +
         urad::radiosity_bytes(scene.patch_count, urad::longest_run(scene));
}

std::size_t hemicube_ram(const urad_scene& scene, int resolution, int rows, bool coverage) {
  return kHemicubeSourceBytes + urad::hemicube_bytes(std::uint16_t(resolution), std::uint16_t(rows),
                                                     scene.patch_count, coverage,
                                                     std::uint16_t(most_vertices(scene)));
}

std::size_t hemicube_flash(int resolution) {
  const std::size_t quarter = std::size_t(resolution / 2) * std::size_t(resolution / 2);
  return 2 * quarter * sizeof(std::uint32_t);
}

std::size_t net_flash(int inputs, int hidden, int bits) {
  constexpr int kStruct = 44, kPerHidden = 4 + 4 + 2;
  return std::size_t(kStruct + hidden * (inputs * bits / 8 + kPerHidden) + 2 * inputs);
}

}  // namespace host
