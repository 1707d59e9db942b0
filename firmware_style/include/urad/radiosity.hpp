// radiosity.hpp -- progressive refinement [Cohen, Chen, Wallace, Greenberg 1988] as init/step/done.
//
//   B_i = E_i + rho_i sum_j F_ij B_j;   shooting j:  A_i dB_i = rho_i F_ji (A_j dB_j)
//
// State is power, A B, split into what a patch has shot and what it has not: B is their
// sum over A. Factors come from a urad_source, one row a shot, run by run; none is stored. The
// symmetric repair of rows is the source's.
//
// Rounding, all of it symmetric in sign, so that a mirrored scene gives mirrored bits:
//
// - A shot takes the 15 leading bits of the unshot power of each channel; the rest stays unshot.
// - rho times that is brought to 15 bits by a dither that follows the number of the shot, so that
//   errors (6e-5 at most in one shot) do not add up over shots of equal power.
// - F times that, two 32-bit products, is brought to whole units with the rest carried along the
//   surface: what a surface reflects in a shot is right to half a unit. Shots below 256 units are
//   cut instead, which lets the last of the light die out.
// - What is handed out and not reflected is absorbed, to the last unit.
#pragma once
#include "urad/radiosity.h"
#include "urad/status.hpp"

namespace urad {

using Radiosity = urad_radiosity;
using Ledger = urad_ledger;

/// Bytes of memory radiosity_init() needs; constexpr, so that the memory can be a static array.
constexpr size_t radiosity_bytes(uint16_t patch_count, uint16_t longest_run) noexcept {
  return URAD_RADIOSITY_BYTES(patch_count, longest_run);
}

/// Patches of the largest surface: with it every surface is one run. Any shorter run from 1 on
/// gives the same bits with less memory and more calls of the source.
uint16_t longest_run(const urad_scene& scene) noexcept;

/// Starts a solve of `scene` (which has passed scene_check()) with factors from `source`.
///
/// flags: URAD_OVERSHOOT and URAD_SKIP_OFF_*. memory: 4-byte aligned, at least
/// radiosity_bytes(scene.patch_count, run).
///
/// Failure: bad_argument, bad_scene (no patch), out_of_memory, overflow (a patch that emits
/// URAD_POWER_LIMIT or more); nothing is then written, neither to *state nor to the memory.
Status radiosity_init(Radiosity* state, const urad_scene* scene, const urad_source& source,
                      unsigned flags, uint16_t run, void* memory, size_t bytes) noexcept;

/// One shot from the patch with the largest |unshot|, red, green and blue together. Nothing unshot:
/// ok, nothing done.
///
/// Overshooting [Feda & Purgathofer 1992] adds the share of the others' ambient power that will
/// come back; the patch then waits with unshot power of the other sign. It needs about half the
/// shots.
///
/// Rows: in an open scene, what a row lacks to 1 has escaped. A surplus (in a closed scene, any
/// remainder up to 2^-8) stays with the shooter as unshot power, so that later shots in effect
/// divide the row by its sum. In a closed scene a remainder above 2^-8 is booked as escaped, with
/// its sign, and counted. Rows are cut at 1.5.
///
/// Failure:
///
/// - A status of the source: what was handed out before it failed stays so and is booked. The
///   ledger holds and step may be called again, but B keeps the error of that part of a shot.
/// - overflow: a patch has reached URAD_POWER_LIMIT. Nothing has wrapped, the ledger holds; the
///   status stays.
/// - diverges: over patch_count shots (with overshooting over 64 at least, four times in a row) the
///   sum of |unshot| fell by less than 1/4096; the status stays.
///
/// Cost on a Cortex-M0, counted in the code: 17 instructions (-O2) per receiver and
/// channel, 25 per receiver for the sum of the row and the choice of the next shooter, and the
/// source's.
Status radiosity_step(Radiosity* state) noexcept;

/// Steps until done at error_uq32 or `budget` shots are made, whichever comes first: what a renderer
/// calls once a frame. *shots (may be null): how many were made. Failure: as radiosity_step().
Status radiosity_steps(Radiosity* state, uint32_t budget, uint32_t error_uq32,
                       uint32_t* shots) noexcept;

/// Estimate of the relative rms error of B, UQ0.32 saturating: what is still to be reflected over
/// all that will be,
///
///   3/2 r g U / (T + r g U),  U = |sum of unshot| + 3/8 (sum of |unshot| - |sum of unshot|)
///
/// T: reflected so far; r: mean reflectance times the mean row sum of recent shots; g = 1 / (1 -
/// r), so that r g U is what U comes to after all its bounces [Cohen et al. 1988, ambient term].
/// Positive and negative unshot power, which overshooting leaves side by side, cancel but for their
/// pattern: 3/8 is measured. 3/2 is the safety that rooms with lit and dark parts need: on cubes and
/// Cornell boxes of reflectance 0.5 to 0.97, 1 % estimated was 0.37 to 1.01 % rms. 0 when nothing is
/// left to shoot.
uint32_t radiosity_error_uq32(const Radiosity& state) noexcept;

/// True when that estimate is at most error_uq32 (1 % = 42949673), or the solve has stopped with a
/// status.
bool radiosity_done(const Radiosity& state, uint32_t error_uq32) noexcept;

/// Makes ready for light that changes during a solve [Chen 1990]: keeps what every patch emits in
/// `memory` (4-byte aligned, URAD_RELIGHT_BYTES, the caller's, kept). To be called while the
/// scene's materials are those of radiosity_init(). bad_argument, out_of_memory: nothing is written.
Status radiosity_relight_init(Radiosity* state, void* memory, size_t bytes) noexcept;

/// From now on patch `patch` emits `exitance` (0 .. 2^30, the scene's unit) instead of what it did:
/// the difference, of either sign, becomes unshot power, and the steps that follow lead from the
/// present light to the one that a solve from the start would reach, within the error asked for.
/// Cost: 400 instructions, and one look over all patches at the next step.
///
/// bad_argument: not ready, no such patch, exitance out of range. overflow: a power would reach
/// URAD_POWER_LIMIT. Nothing is then written.
Status radiosity_set_emission(Radiosity* state, uint16_t patch, const int32_t* exitance) noexcept;

/// Gives one material of the scene, which must be in RAM, another reflectance (UQ1.15, <= 32768).
/// What its patches have reflected so far grows or shrinks in proportion, and the difference becomes
/// unshot power. In channels that have been black nothing tells what light has met them: it is gathered
/// over what all patches have shot, by reciprocity (a hemicube's rows are not reciprocal, and leave
/// their error). Cost: 500 instructions a patch of the material, 300 for every other; where it was
/// black, a row of factors a patch.
///
/// bad_argument: not ready, `material` not in the scene's table, reflectance out of range. overflow as
/// above. A status of the source, wherever it fails. Nothing is then changed.
Status radiosity_set_reflectance(Radiosity* state, urad_material* material,
                                 const uint16_t* reflectance_uq15) noexcept;

/// Radiosity of `patches` patches under up to 32767 lights, [patches][3]: the sum of basis * colour,
/// each product rounded.
void light_mix(const urad_light* light, uint16_t lights, uint16_t patches,
               uint32_t* radiosity) noexcept;

/// Radiosity B of a patch in the scene's exitance unit, rounded, saturating. patch < patch_count,
/// channel < 3 (unchecked).
int32_t radiosity_get(const Radiosity& state, uint16_t patch, int channel) noexcept;

/// Ambient term in exitance units: unshot power over total area, times g of the estimate above.
int32_t radiosity_ambient(const Radiosity& state, int channel) noexcept;

/// B + rho * ambient: for display before the solve is done.
int32_t radiosity_display(const Radiosity& state, uint16_t patch, int channel) noexcept;

/// The ledger with `unshot` summed again from the patches. True if it agrees with the running sum
/// and emitted = absorbed + unshot + escaped in every channel. ledger may be null.
bool radiosity_audit(const Radiosity& state, Ledger* ledger) noexcept;

}  // namespace urad
