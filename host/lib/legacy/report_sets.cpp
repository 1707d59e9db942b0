// Table 3.1 as printed, and what each of its sets is drawn from here. The report names no ranges:
// these give sets of the printed kind (large, small and evened-out factors; near and far pairs).
#include "legacy/random_quads.hpp"

namespace host {

namespace {

constexpr QuadRange kAny{0.1, 0.6, 0.7, 2, 0.15, 0.8};
constexpr QuadRange kClose{0.1, 0.6, 0.8, 4, 0.03, 0.6};
constexpr QuadRange kSmall{0.08, 0.4, 0.7, 2, 0.15, 1};
constexpr QuadRange kTouching{0.2, 0.8, 1, 3, 0.005, 0.1},
    kSmallGatherer{0.04, 0.15, 3, 10, 0.2, 0.6};
constexpr QuadRange kSpecks{0.005, 0.03, 0.7, 1.5, 0.3, 1}, kMixed{0.05, 0.4, 1, 10, 0.05, 0.5};

QuadRange within(QuadRange range, double low, double high) {
  range.f_low = low;
  range.f_high = high;
  return range;
}

}  // namespace

const std::vector<QuadSet>& report_sets() {
  // A row of the printed table is a row here.
  // clang-format off
  static const std::vector<QuadSet> sets = {
      // large factors
      {'A', 1001, {within(kTouching, 0.5, 1)},                      0,  0.6557,  0.6304, 0.9953,   0.5000,  0.0119, 0.0812,  0.1111, 0.1104,  true, true},
      {'B', 1001, {within(kAny, 0.1, 1)},                           0,  0.1576,  0.1364, 0.5763,   0.1000, -0.0025, 0.0423,  0.0045, 0.0339,  true, true},
      {'C', 1001, {within(kAny, 0.1, 1)},                           0,  0.1536,  0.1341, 0.6043,   0.1001,  0.0010, 0.0416,  0.0014, 0.0339, false, true},
      {'D', 2001, {within(kAny, 0.1, 1), within(kClose, 0.5, 1)},   0,  0.3722,  0.5005, 0.9108,   0.1000, -0.0063, 0.0532,  0.0230, 0.0565,  true, true},
      {'E', 1001, {within(kSmallGatherer, 0.1, 1)},                 0,  0.1574,  0.1374, 0.6258,   0.1001,  0.0019, 0.0435, -0.0076, 0.0110,  true, true},
      // small factors
      {'F',  989, {kAny},                                           0,  0.0248,  0.0101, 0.4532,  4.17e-7, -0.0054, 0.0324, -2.1e-4, 0.0076,  true, true},
      {'G',  989, {kSpecks},                                        0, 3.14e-5, 6.36e-6, 0.0023, 3.81e-11,  0.0069, 0.0424,  1.2e-6, 1.3e-4,  true, true},
      {'H',  998, {kSmall},                                         0,  0.0103,  0.0031, 0.2701,  7.49e-9, -0.0074, 0.0202, -9.6e-5, 0.0097,  true, true},
      {'I',  978, {kClose},                                         0,  0.0441,  0.0215, 0.6944,  4.43e-7, -0.0037, 0.0411,  8.8e-4, 0.0178,  true, true},
      // evened out
      {'J',  377, {kMixed},                                        50,  0.3673,  0.3603, 0.9052,  1.44e-6, -0.0101, 0.0634,  0.0046, 0.0511,  true, true},
      {'K',  410, {kMixed},                                        50,  0.3979,  0.4033, 0.9543,  2.02e-7, -0.0160, 0.0645,  0.0035, 0.0517,  true, true},
      {'L', 1425, {kMixed},                                       200,  0.3470,  0.3470, 0.8214,  4.01e-7, -0.0057, 0.0626,  0.0056, 0.0513,  true, true},
      {'M', 1507, {kMixed},                                       200,  0.3676,  0.3677, 0.8957,  1.44e-6, -0.0084, 0.0630,  0.0063, 0.0553,  true, true},
      {'N',  371, {kMixed},                                        50,  0.3591,  0.3682, 0.8117,  1.06e-6, -0.0064, 0.0607,  0.0041, 0.0469,  true, true},
      {'O',  414, {kMixed},                                        50,  0.4014,  0.4095, 0.9238,  1.27e-5, -0.0110, 0.0620,  0.0035, 0.0557,  true, true},
  };
  // clang-format on
  return sets;
}

}  // namespace host
