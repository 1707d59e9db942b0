#include "report/ply.hpp"

#include <fmt/core.h>

#include <bit>
#include <cstdint>

#include "report/picture.hpp"

namespace host {
namespace {

constexpr const char* kHeader =
    "ply\n"
    "format binary_little_endian 1.0\n"
    "comment urad radiosity; red, green, blue are sRGB with white at radiosity {:.9g}\n"
    "element vertex {}\n"
    "property float x\n"
    "property float y\n"
    "property float z\n"
    "property uchar red\n"
    "property uchar green\n"
    "property uchar blue\n"
    "property float radiosity_red\n"
    "property float radiosity_green\n"
    "property float radiosity_blue\n"
    "element face {}\n"
    "property list uchar int vertex_indices\n"
    "property int patch\n"
    "end_header\n";

void put_u32(std::uint32_t value, std::string* out) {
  for (int shift = 0; shift < 32; shift += 8) out->push_back(char((value >> shift) & 255U));
}

void put_vector(const Vec3& x, std::string* out) {
  for (int k = 0; k < 3; ++k) put_u32(std::bit_cast<std::uint32_t>(float(x[k])), out);
}

}  // namespace

std::string ply(const Scene& scene, const CornerMesh& mesh, const std::vector<Vec3>& radiosity,
                double white) {
  const std::vector<Vec3> colour = smooth_colours(scene, mesh, radiosity);
  std::string out = fmt::format(kHeader, white, mesh.vertex.size(), mesh.facets.size());
  for (std::size_t v = 0; v < mesh.vertex.size(); ++v) {
    put_vector(mesh.vertex[v], &out);
    for (int k = 0; k < 3; ++k) out.push_back(char(srgb_byte(colour[v][k] / white)));
    put_vector(colour[v], &out);
  }
  for (const Facet& facet : mesh.facets) {
    const std::size_t corners = facet.quad ? 4 : 3;
    out.push_back(char(corners));
    for (std::size_t k = 0; k < corners; ++k) put_u32(std::uint32_t(facet.vertex[k]), &out);
    put_u32(std::uint32_t(facet.patch), &out);
  }
  return out;
}

}  // namespace host
