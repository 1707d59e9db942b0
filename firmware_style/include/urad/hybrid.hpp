// hybrid.hpp -- factors whose visibility comes from a hemicube and whose magnitude comes from a
// network or kernel.
//
//   F_ij = (visible cells of j / cells that j covers) * G_ij / A_i
//
// An item buffer at the centre of the shooter is good at *what* is seen and poor at *how much* in
// the near field; a network is the other way round. A receiver that covers no cell gets its
// fraction from rays.
#pragma once
#include "urad/form_factor.hpp"
#include "urad/hemicube.hpp"

namespace urad {

/// rho of two equal squares whose centres are three sides apart, UQ16.16.
inline constexpr uint32_t kThreePatches_uq16 = 65536 / 27;

/// A source (source.h). With near_rho_uq16 = 0 every pair is done as above. With near_rho_uq16 > 0
/// only pairs with rho = (tr M_i + tr M_j) / R^2 above it are. All others keep the hemicube's
/// factor, which is that of the shooter's centre, times exp(T2) of the shooter (pair.hpp), which
/// makes it the mean over the shooter to second order; then one number per row brings the row back
/// to the sum that the hemicube saw: for a closed scene 1 to the rounding of each factor, for an
/// open one 1 less what escapes.
struct HybridSource {
  HemicubeSource* hemicube;  ///< with hemicube_coverage unless the scene is convex
  const urad_net* net;       ///< null: kernel alone
  Kernel kernel;
  uint16_t rays;           ///< 1 .. 1024, for receivers that cover no cell
  uint32_t near_rho_uq16;  ///< 0: all pairs; kThreePatches_uq16: centres closer than three patches
  int32_t shooter;         ///< whose finished row stands in hemicube->visible_uq32; -1: nobody's
  uint32_t skips_off = 0;  ///< SkipOff bits: far, facing, behind
};

/// The hemicube is the hybrid's from now on: its row is overwritten by the finished factors. `net`
/// and `hemicube` are kept. bad_argument on null pointers, rays out of range, or a hemicube without
/// coverage on a scene that is not convex.
Status hybrid_init(HybridSource* source, HemicubeSource* hemicube, Kernel kernel,
                   const urad_net* net, uint16_t rays, uint32_t near_rho_uq16) noexcept;

/// urad_fill for a HybridSource: bad_argument on a bad index, else ok.
urad_status hybrid_fill(void* hybrid_source, uint16_t shooter, uint16_t surface, uint16_t first,
                        uint16_t count, uint32_t* f_uq32) noexcept;

}  // namespace urad
