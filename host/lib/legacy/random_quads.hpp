// Free quads as section 3.2 of the 1996 report makes them, and its fifteen sets of pairs.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "geometry/polygon.hpp"
#include "network/random.hpp"

namespace host {

/// Four corners by a random walk from `start` about a plane with a random normal, steps up to
/// `step` along either axis of the plane; nothing when it leaves the unit cube, crosses itself or
/// has no area.
std::optional<Polygon> random_quad(Random& random, const Vec3& start, double step);

/// Turns p and q to face each other. False when either lies across the other's plane: then no pair
/// of their faces sees all of each other.
bool turn_to_face(Polygon* p, Polygon* q);

/// What a set is drawn from: "changing the average distance between the patches and the relative
/// size between the patches allowed the range of form factor values to be varied".
struct QuadRange {
  double step_low, step_high;          ///< walk of p, logarithmic
  double ratio_low, ratio_high;        ///< walk of q over that of p, logarithmic
  double distance_low, distance_high;  ///< from the start of p to the start of q, logarithmic
  double f_low = 0, f_high = 1;        ///< factors that are kept
};

/// A set of Table 3.1 with what the report printed about it.
struct QuadSet {
  char name;
  int samples;
  std::vector<QuadRange> ranges;            ///< equal shares of the samples
  int bin_limit;                            ///< most samples in a bin of F 0.1 wide; 0: no bins
  double mean, median, max, min;            ///< printed: of F
  double nn_mean, nn_std, hc_mean, hc_std;  ///< printed: of the errors of network and hemicube
  bool t_rejects, f_rejects;                ///< printed
};

const std::vector<QuadSet>& report_sets();

struct QuadPair {
  Polygon p, q;
  double exact = 0;  ///< F from p to q by the reference
};

/// The set's pairs, or `samples` of them if that is fewer (bins shrink along). Not one number of
/// the report goes in but the counts.
std::vector<QuadPair> draw(const QuadSet& set, std::uint64_t seed, int samples);

}  // namespace host
