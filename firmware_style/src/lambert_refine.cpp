#include "lambert_refiner.hpp"

namespace urad {

LambertSum lambert_refined(const urad_scene& scene, const Patch& i, const Patch& j, int points,
                           int halvings) noexcept {
  LambertPair pair;
  if (!lambert_pair(scene, i, j, &pair)) return {kNoExchange, 0, 0, {}};
  LambertRun run(scene, pair, points);
  while (halvings-- > 0 && run.halve_worst()) {
  }
  return run.sum();
}

}  // namespace urad
