#include "report/picture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "report/camera.hpp"
#include "report/primary_rays.hpp"

// The library is one header; its code lives here, unseen by other files.
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

namespace host {
namespace {

const Vec3 kBackgroundLinear(0.006, 0.0065, 0.008);

double largest(const Vec3& c) { return std::max({c.x, c.y, c.z}); }

std::uint8_t grey(double signed_error) {
  const double span = signed_error < 0 ? 128 : 127;
  return std::uint8_t(std::lround(128 + span * std::clamp(signed_error, -1.0, 1.0)));
}

/// Smallest of 1, 2, 5 times a power of ten that is not below x.
double round_up_125(double x) {
  const double decade = std::pow(10, std::floor(std::log10(x)));
  for (const double step : {1.0, 2.0, 5.0})
    if (x <= step * decade * (1 + 1e-12)) return step * decade;
  return 10 * decade;
}

std::vector<Vec3> minus(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  if (a.size() != b.size())
    throw Error(fmt::format("cannot compare solutions of {} and {} patches", a.size(), b.size()));
  std::vector<Vec3> d(a.size());
  std::transform(a.begin(), a.end(), b.begin(), d.begin(), std::minus<>());
  return d;
}

}  // namespace

std::uint8_t srgb_byte(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  const double y = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  return std::uint8_t(std::lround(255 * y));
}

double white_level(const Scene& scene, const std::vector<Vec3>& exact) {
  std::vector<std::pair<double, double>> shown, all;  // value, area
  for (std::size_t k = 0; k < exact.size(); ++k) {
    const std::pair<double, double> entry{largest(exact[k]), scene.patches[k].moments.area};
    all.push_back(entry);
    if (largest(scene.material_of(k).exitance) <= 0) shown.push_back(entry);
  }
  if (shown.empty()) shown = all;
  std::sort(shown.begin(), shown.end());
  const auto add = [](double sum, const auto& entry) { return sum + entry.second; };
  const double goal = 0.99 * std::accumulate(shown.begin(), shown.end(), 0.0, add);
  double area = 0, level = 0;
  for (const auto& [value, patch_area] : shown) {
    level = value;
    area += patch_area;
    if (area >= goal) break;
  }
  return level > 0 ? level : 1;
}

View::View(const Scene& scene, const PictureOptions& options)
    : scene_(scene),
      options_(options),
      mesh_(merge_corners(scene)),
      camera_(camera_of(scene)),
      outside_(outside_room(mesh_, camera_.eye)) {
  if (std::min(options.width, options.height) < 1 ||
      std::max(options.width, options.height) > 16384)
    throw Error(fmt::format("picture size must be 1 to 16384 pixels a side, not {} x {}",
                            options.width, options.height));
  if (options.strata < 2 || options.strata > 16)
    throw Error(fmt::format("samples along a pixel must be 2 to 16, not {}", options.strata));
  trace();
}

void View::trace() {
  const PrimaryRays rays(scene_, mesh_, camera_, double(options_.width) / options_.height,
                         outside_);
  const std::size_t width = std::size_t(options_.width), height = std::size_t(options_.height);
  const std::size_t strata = std::size_t(options_.strata);
  samples_.resize(width * height * strata * strata);
  parallel_for(height, options_.threads, [&](std::size_t row) {
    Sample* out = &samples_[row * width * strata * strata];
    for (std::size_t column = 0; column < width; ++column)
      for (std::size_t s = 0; s < strata * strata; ++s) {
        // Each sample has a column and a row of its own: upright edges get strata^2 levels, and no
        // noise.
        const std::size_t in_row = s % strata, in_column = s / strata;
        const double i = double(in_row), j = double(in_column), n = double(strata);
        const double dx = (i + (j + 0.5) / n) / n, dy = (j + (i + 0.5) / n) / n;
        const RayHit hit =
            rays.trace((double(column) + dx) / double(width), (double(row) + dy) / double(height));
        const std::uint32_t what = hit.kind == RayHit::kFacet  ? hit.facet
                                   : hit.kind == RayHit::kDark ? kDark
                                                               : kBackground;
        *out++ = {what, hit.u, hit.v};
      }
  });
}

template <class Tone>
std::vector<Vec3> View::resolve(const std::vector<Vec3>& radiosity, Shading shading,
                                const Vec3& none, Tone&& tone) const {
  const std::vector<Vec3> corners = smooth_colours(scene_, mesh_, radiosity);
  const std::size_t per_pixel = std::size_t(options_.strata) * std::size_t(options_.strata);
  const std::size_t width = std::size_t(options_.width);
  std::vector<Vec3> pixels(samples_.size() / per_pixel);
  parallel_for(std::size_t(options_.height), options_.threads, [&](std::size_t row) {
    for (std::size_t pixel = row * width; pixel < (row + 1) * width; ++pixel) {
      Vec3 sum(0);
      for (std::size_t s = pixel * per_pixel; s < (pixel + 1) * per_pixel; ++s) {
        const Sample& sample = samples_[s];
        if (sample.facet == kBackground) {
          sum += none;
        } else if (sample.facet == kDark) {
          sum += tone(Vec3(0));
        } else {
          const Facet& facet = mesh_.facets[sample.facet];
          sum += tone(shading == Shading::kFlat
                          ? radiosity[facet.patch]
                          : interpolate(facet, corners, double(sample.u), double(sample.v)));
        }
      }
      pixels[pixel] = sum / double(per_pixel);
    }
  });
  return pixels;
}

Image View::picture(const std::vector<Vec3>& radiosity, Shading shading, double white) const {
  // Clamped before the average, so that the edge of a bright lamp is as smooth as any other.
  const auto tone = [white](const Vec3& b) { return glm::clamp(b / white, 0.0, 1.0); };
  Image image{options_.width, options_.height, 3, {}};
  for (const Vec3& c : resolve(radiosity, shading, kBackgroundLinear, tone))
    for (int k = 0; k < 3; ++k) image.pixels.push_back(srgb_byte(c[k]));
  return image;
}

Image View::difference(const std::vector<Vec3>& radiosity, const std::vector<Vec3>& exact,
                       Shading shading, double scale, Channel channel) const {
  const double inverse = scale > 0 ? 1 / scale : 0;
  const auto tone = [inverse](const Vec3& d) { return inverse * d; };
  const bool all = channel == Channel::kAll;
  Image image{options_.width, options_.height, all ? 3 : 1, {}};
  for (const Vec3& d : resolve(minus(radiosity, exact), shading, Vec3(0), tone)) {
    if (!all) image.pixels.push_back(grey(d[int(channel)]));
    for (int k = 0; all && k < 3; ++k) image.pixels.push_back(grey(d[k]));
  }
  return image;
}

double View::difference_scale(const std::vector<Vec3>& radiosity, const std::vector<Vec3>& exact,
                              Shading shading, double white) const {
  std::vector<double> size;
  const auto tone = [white](const Vec3& d) { return d / white; };
  for (const Vec3& d : resolve(minus(radiosity, exact), shading, Vec3(0), tone)) {
    const double worst = largest(glm::abs(d));
    if (worst > 0) size.push_back(worst);  // background and lamps say nothing about the error
  }
  if (size.empty()) return 0;
  const auto rank = std::ptrdiff_t(0.99 * double(size.size() - 1));
  std::nth_element(size.begin(), size.begin() + rank, size.end());
  return white * round_up_125(size[std::size_t(rank)]);
}

std::string png(const Image& image) {
  int bytes = 0;
  unsigned char* data = stbi_write_png_to_mem(image.pixels.data(), image.width * image.channels,
                                              image.width, image.height, image.channels, &bytes);
  if (!data) throw Error("not enough memory to write a PNG");
  std::string out(reinterpret_cast<const char*>(data), std::size_t(bytes));
  STBIW_FREE(data);
  return out;
}

}  // namespace host
