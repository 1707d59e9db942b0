// Light that changes, frame by frame: a strip of light that moves over a lamp, a wall that is
// painted, an object that moves.
#pragma once
#include <string>
#include <vector>

#include "method/engine_source.hpp"
#include "report/picture.hpp"

namespace host {

struct AnimationOptions {
  int shots = 20;         ///< a frame: what a 48 MHz Cortex-M0 has time for at 30 frames a second
  int frames = 8;         ///< after each move of the strip
  int paint_frames = 32;  ///< after the wall was painted
  int steps = 8;          ///< of an object that moves
  PictureOptions picture;
};

/// Frames, and what they are: frame, what changed, shots since the start, relative rms error of B
/// against the converged solution of the light as it is then.
struct Animation {
  std::vector<Image> frames;
  std::string table;  ///< CSV
};

/// One column of the first lamp that is a grid is lit; from the converged solution it moves column
/// by column. Throws Error when no lamp is a grid of two columns or more.
Animation animate_strip(const Scene& scene, const EngineRows& rows,
                        const AnimationOptions& options);

/// The wall of the most vivid reflectance that emits nothing gets its channels exchanged, red to
/// green to blue. Throws Error when all walls are grey.
Animation animate_wall(const Scene& scene, const EngineRows& rows, const AnimationOptions& options);

/// The smallest object of the scene goes half its free way in `steps`, its factors made again by the
/// general network and 16 rays; the error is against a solve from the start. No frames where a scene
/// has no object that could move.
Animation animate_object(const Scene& scene, const NetChoice& nets,
                         const AnimationOptions& options);

}  // namespace host
