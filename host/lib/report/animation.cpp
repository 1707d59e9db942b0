#include "report/animation.hpp"

#include <fmt/core.h>

#include "base/csv.hpp"
#include "base/error.hpp"
#include "solve/fixed_solve.hpp"
#include "solve/moving.hpp"
#include "solve/relight.hpp"

namespace host {
namespace {

constexpr double kConverged = 1e-4;

class Recorder {
 public:
  Recorder(const Scene& scene, const EngineRows& rows, const AnimationOptions& options)
      : light(scene, rows, true), options_(options), view_(scene, options.picture), scene_(scene) {
    animation.table = csv_line({"frame", "change", "shots", "error"});
  }

  /// To the end of the light as it is; sets what is shown as white.
  void settle() {
    const std::vector<Vec3> truth = light.converged();
    while (light.error(truth) > kConverged && light.step(options_.shots) > 0) {
    }
    white_ = white_level(scene_, truth);
    record("settled", truth);
  }

  void shoot(const std::string& change, int frames) {
    const std::vector<Vec3> truth = light.converged();
    for (int k = 0; k < frames; ++k) {
      shots_ += light.step(options_.shots);
      record(change, truth);
    }
  }

  Relighting light;
  Animation animation;

 private:
  void record(const std::string& change, const std::vector<Vec3>& truth) {
    animation.table +=
        csv_line({std::to_string(animation.frames.size()), change, std::to_string(shots_),
                  fmt::format("{:.6f}", light.error(truth))});
    animation.frames.push_back(view_.picture(light.radiosity(), Shading::kSmooth, white_));
  }

  const AnimationOptions& options_;
  View view_;
  const Scene& scene_;
  double white_ = 1;
  int shots_ = 0;
};

double vividness(const Material& material) {
  const Vec3& r = material.reflectance;
  return std::max({r.x, r.y, r.z}) - std::min({r.x, r.y, r.z});
}

}  // namespace

Animation animate_strip(const Scene& scene, const EngineRows& rows,
                        const AnimationOptions& options) {
  for (const Surface& lamp : scene.surfaces) {
    const Vec3 exitance = scene.materials[std::size_t(lamp.material)].exitance;
    if (exitance == Vec3(0) || !lamp.grid || lamp.grid->count_u < 2) continue;
    Recorder recorder(scene, rows, options);
    const auto light_column = [&](int column) {
      for (int k = 0; k < lamp.patch_count; ++k) {
        const bool lit = k % lamp.grid->count_u == column;
        recorder.light.emit(std::size_t(lamp.first_patch + k), lit ? exitance : Vec3(0));
      }
    };
    light_column(0);
    recorder.settle();
    for (int column = 1; column < lamp.grid->count_u; ++column) {
      light_column(column);
      recorder.shoot(fmt::format("column {}", column), options.frames);
    }
    return std::move(recorder.animation);
  }
  throw Error(scene.name +
              ": no lamp is a grid of two columns or more, over which a strip could move");
}

Animation animate_wall(const Scene& scene, const EngineRows& rows,
                       const AnimationOptions& options) {
  int vivid = -1;
  for (std::size_t k = 0; k < scene.materials.size(); ++k) {
    const Material& material = scene.materials[k];
    if (material.exitance != Vec3(0)) continue;
    if (vivid < 0 || vividness(material) > vividness(scene.materials[std::size_t(vivid)]))
      vivid = int(k);
  }
  if (vivid < 0 || vividness(scene.materials[std::size_t(vivid)]) < 0.05)
    throw Error(scene.name + ": all walls are grey; painting one would change nothing");
  const Material& material = scene.materials[std::size_t(vivid)];
  const Vec3 r = glm::max(material.reflectance, Vec3(1.0 / 64));
  Recorder recorder(scene, rows, options);
  recorder.settle();
  recorder.light.paint(vivid, {r.z, r.x, r.y});
  recorder.shoot(material.name + " painted", options.paint_frames);
  return std::move(recorder.animation);
}

Animation animate_object(const Scene& scene, const NetChoice& nets,
                         const AnimationOptions& options) {
  Animation animation;
  animation.table = csv_line({"frame", "change", "shots", "pairs", "error"});
  const std::vector<int> object = smallest_object(scene);
  const Vec3 way = free_way(scene, object, scene.camera.up);
  if (object.empty() || way == Vec3(0)) return animation;
  const MethodSpec net = parse_method("net");
  const EngineOptions engine{.rays = 16};
  const int settled = 6 * int(scene.patches.size());
  Moving light(scene, net, nets, engine, true);
  light.step(settled);
  const double white = white_level(scene, light.radiosity());
  int shots = 0;
  std::uint32_t pairs = 0;
  for (int step = 0; step <= options.steps; ++step) {
    if (step > 0) {
      light.move(object, {glm::dmat3(1), way / double(options.steps)});
      pairs += light.last().made;
    }
    Moving start(light.scene(), net, nets, engine, true);
    start.step(settled);
    const std::vector<Vec3> truth = start.radiosity();
    const View view(light.scene(), options.picture);
    for (int frame = 0; frame < (step > 0 ? options.frames : 1); ++frame) {
      if (step > 0) shots += light.step(options.shots);
      animation.table +=
          csv_line({std::to_string(animation.frames.size()),
                    step > 0 ? fmt::format("step {}", step) : "settled", std::to_string(shots),
                    std::to_string(pairs),
                    fmt::format("{:.6f}", relative_rms(light.scene(), light.radiosity(), truth))});
      animation.frames.push_back(view.picture(light.radiosity(), Shading::kSmooth, white));
    }
  }
  return animation;
}

}  // namespace host
