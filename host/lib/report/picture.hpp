// Pictures of a solved scene from its camera, and pictures of the error.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "report/smooth.hpp"

namespace host {

struct PictureOptions {
  int width = 480, height = 480;  ///< pixels, 1 .. 16384
  int strata = 3;                 ///< strata^2 samples a pixel [Chiu, Shirley, Wang 1994], 2 .. 16
  int threads = 0;                ///< 0: all cores
};

enum class Shading { kFlat, kSmooth };
enum class Channel { kRed = 0, kGreen = 1, kBlue = 2, kAll = 3 };

/// 8 bits a channel, rows from the top, 1 (grey) or 3 (sRGB) channels.
struct Image {
  int width = 0, height = 0, channels = 3;
  std::vector<std::uint8_t> pixels;
};

/// The radiosity shown as white: the 99th percentile, by area, of the largest channel over the
/// patches that emit nothing (over all patches when each of them emits). Compute it once, from the
/// exact solution, for all methods. Never 0: a black scene gives 1.
double white_level(const Scene& scene, const std::vector<Vec3>& exact);

/// A channel of a picture: linear light 0 .. 1 (clamped) to sRGB 0 .. 255 [IEC 61966-2-1].
std::uint8_t srgb_byte(double linear);

/// Traces the primary rays once; every picture of the scene is then a matter of shading, with the
/// same samples. A camera outside the room looks through walls that face away; inside, the back of
/// a patch is opaque and black.
class View {
 public:
  /// The scene must outlive the view. Throws Error for an option outside its range.
  explicit View(const Scene& scene, const PictureOptions& options = {});

  /// sRGB picture. `white` as from white_level().
  Image picture(const std::vector<Vec3>& radiosity, Shading shading, double white) const;

  /// (radiosity - exact) / scale: grey 128 = no error, white >= +scale, black <= -scale, linear in
  /// between. Channel::kAll gives RGB, else one grey channel.
  Image difference(const std::vector<Vec3>& radiosity, const std::vector<Vec3>& exact,
                   Shading shading, double scale, Channel channel) const;

  /// A scale for difference(): 1, 2 or 5 times a power of ten, times `white`, that 99 % of the
  /// pixels stay within. 0 when the two solutions agree in every pixel.
  double difference_scale(const std::vector<Vec3>& radiosity, const std::vector<Vec3>& exact,
                          Shading shading, double white) const;

  const CornerMesh& mesh() const { return mesh_; }
  /// Whether the camera looks in from outside.
  bool outside() const { return outside_; }

 private:
  struct Sample {
    std::uint32_t facet;  ///< or kBackground, kDark
    float u, v;
  };
  static constexpr std::uint32_t kBackground = 0xFFFFFFFF, kDark = 0xFFFFFFFE;

  void trace();
  template <class Tone>
  std::vector<Vec3> resolve(const std::vector<Vec3>& radiosity, Shading shading, const Vec3& none,
                            Tone&& tone) const;

  const Scene& scene_;
  PictureOptions options_;
  CornerMesh mesh_;
  Camera camera_;
  bool outside_;
  std::vector<Sample> samples_;
};

/// The image as a PNG file's bytes.
std::string png(const Image& image);

}  // namespace host
