// Form factors from moments alone: the two closed forms that the integer engine approximates.
#pragma once
#include "form_factor/estimate.hpp"
#include "geometry/polygon.hpp"

namespace host {

/// Exchange of two small patches at their centroids: K0 = A_i A_j p q / (pi R^4), with r = c_j -
/// c_i, p = n_i.r, q = -n_j.r; 0 when either centroid is behind the other's plane. No clipping: the
/// caller has done it.
double centre_kernel(const Moments& i, const Moments& j);

/// T2, the term of second order in size over distance. Both centroids in front of the other's plane.
double second_order(const Moments& i, const Moments& j);

/// K0 exp(t / sqrt(1 + (t/1.5)^2)), t the sum of the terms above K0.
double bent_kernel(const Moments& i, const Moments& j, double terms);

/// K0 exp(T2 / sqrt(1 + (T2/1.5)^2)): second order in size over distance, T2 = sum over both
/// patches of -2 tr M/R^2 + 12 r.Mr/R^4 - 4 (m.Mr)/((m.r) R^2) with m the other's normal. Not
/// limited to min(A_i, A_j).
double moment_kernel(const Moments& i, const Moments& j);

/// Both polygons clipped to each other's front half-space first; F is limited to 0..1.
Estimate centre_kernel_estimate(const Polygon& p, const Polygon& q);
Estimate moment_kernel_estimate(const Polygon& p, const Polygon& q);

/// The exchanges of the same.
double centre_kernel_exchange(const Polygon& p, const Polygon& q);
double moment_kernel_exchange(const Polygon& p, const Polygon& q);

}  // namespace host
