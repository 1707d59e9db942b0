// cheapest_models.hpp -- what each way to a form factor is off by: constants for cheapest.hpp.
//
//   Written by  urad evaluate --fit-auto
//   Pairs       2500 of each of 10 families (accuracy/trial_pairs.hpp), stream TrialUse::fit
//   Fit         log2 of the true error against the traits: quantile regression for the slopes, then
//               bases such that the estimate holds for 99 % of every family and every decade of F
//               among the pairs for which the way is chosen
//   Evidence    other pairs: tests/cheapest_test.cpp
//
// An entry is base and weights in the order of Trait; a row is a PairClass.
#pragma once
#include "urad/cheapest.hpp"

namespace urad {

struct ErrorModel {
  int16_t base_q8;
  int16_t weight_q8[kTraits];
};

/// By way, then by class of pair.
inline constexpr ErrorModel kErrorModel[kWays][kPairClasses] = {
    {},  // none
    {
        // kernel
        {511, {136, 36, 298, -9, -94, -17, 0, 0, 0}},
        {-38, {195, 14, 184, -26, -92, -27, 0, 0, 0}},
        {25600, {0, 0, 0, 0, 0, 0, 0, 0, 0}},
        {187, {125, 24, 156, 12, -122, 28, 0, 0, 0}},
    },
    {
        // network
        {39, {91, 42, 294, -53, -86, -50, 0, 0, 0}},
        {-30, {109, 32, 221, -87, -97, -59, 0, 0, 0}},
        {25600, {0, 0, 0, 0, 0, 0, 0, 0, 0}},
        {90, {56, 28, 260, -4, -157, 23, 0, 0, 0}},
    },
    {
        // point
        {337, {35, 0, -43, -92, 100, -19, 178, 78, 0}},
        {-113, {13, 0, -37, -152, -23, -6, 137, 11, 0}},
        {-297, {28, 0, -296, -240, 218, -121, 219, 50, 0}},
        {-305, {90, 0, -206, -89, 3, -63, 165, 89, 0}},
    },
    {
        // four points
        {216, {205, 0, 173, -20, -63, -24, 131, 49, 35}},
        {-233, {178, 0, -165, 14, -65, -33, 306, 49, 44}},
        {-689, {159, 0, -321, -57, 138, -62, 142, 109, 51}},
        {2130, {336, 0, -220, -53, -93, -32, 296, 15, 13}},
    },
    {
        // nine points
        {-1050, {410, 0, 22, -121, -46, 23, 127, -2, 65}},
        {-1061, {312, 0, -189, -50, 14, -56, 266, 21, 75}},
        {-1546, {426, 0, -426, -71, 66, -28, 141, 79, 66}},
        {397, {517, 0, -161, -146, -94, -9, 208, -75, 108}},
    },
    {
        // refined
        {162, {0, 0, 62, -31, 0, 22, 0, 0, 267}},
        {-1175, {0, 0, 96, 90, 0, -44, 0, 0, 142}},
        {298, {0, 0, 94, -79, 0, 35, 0, 0, 282}},
        {94, {0, 0, -6, 73, 0, 0, 0, 0, 235}},
    },
};

/// Guesses at four and nine points before they are computed: about as often too low as too high.
inline constexpr ErrorModel kErrorBefore[2][kPairClasses] = {
    {
        {-587, {240, 0, 132, -57, -57, -17, 148, 56, 0}},
        {-726, {189, 0, -193, -74, -50, -36, 369, 39, 0}},
        {-1407, {203, 0, -391, -97, 165, -54, 173, 143, 0}},
        {-1276, {342, 0, -232, -54, -86, -30, 301, 19, 0}},
    },
    {
        {-1318, {437, 0, 131, -137, -137, 32, 166, 20, 0}},
        {-1696, {366, 0, -202, -53, -84, -45, 365, 82, 0}},
        {-2543, {427, 0, -574, -124, 7, -49, 206, 92, 0}},
        {-2405, {579, 0, -265, -109, -106, -24, 301, -25, 0}},
    },
};

/// 1 / weight of the doubt of a refined sum.
inline constexpr int16_t kRefinedInverse_q8[kPairClasses] = {245, 463, 232, 279};

/// Rounding: of a kernel relative to itself; of a sum relative to a factor of 1.
inline constexpr int16_t kKernelFloor_q8 = -16 * 256, kSumRounding_q8 = -31 * 256;

}  // namespace urad
