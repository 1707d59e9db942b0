// What third moments would bring: the moment kernel with and without them, by kind of patch and by
// how near the two are.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "urad/net.h"

namespace host {

/// |K - exact| / exact of pairs wholly in front of each other.
struct ThirdOrderRow {
  std::string kind;
  double least_rho = 0, most_rho = 0;
  double median2 = 0, p95_2 = 0, within2 = 0;  ///< moments up to the second
  double median3 = 0, p95_3 = 0, within3 = 0;  ///< up to the third; within: share below 1 %
};

/// Two parallelograms, convex quads, concave quads, triangles; rho from 1e-4 to 0.35.
std::vector<ThirdOrderRow> try_third_moments(std::uint64_t seed, std::size_t pairs, int threads);

/// What auto saves by third moments: pairs that are not cut and for which moments say something, at
/// one error asked for.
struct ThirdOrderCost {
  std::string family;
  double error = 0;           ///< asked for
  double two = 0, three = 0;  ///< share of pairs by the kernel, without third moments and with them
  double computed = 0;        ///< share of pairs for which they are
  double held2 = 0, held3 = 0;  ///< share of those by the kernel within what was said
  double macs2 = 0, macs3 = 0;  ///< multiply-adds a pair
};

/// Auto as it is, and the same with a kernel that has no third moments, whose guess is moved until
/// it holds for 99 % of pairs of its own.
std::vector<ThirdOrderCost> try_third_moments_in_auto(std::uint64_t seed, std::size_t pairs,
                                                      const urad_net* net, int threads);

/// In Markdown.
std::string third_order_table(const std::vector<ThirdOrderRow>& rows);
std::string third_order_table(const std::vector<ThirdOrderCost>& rows);

}  // namespace host
