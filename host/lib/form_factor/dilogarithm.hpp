// The dilogarithm Li2(z) = -int_0^z ln(1 - w)/w dw on the closed unit disc, where it has one value:
// its branch cut, from 1 to infinity, lies outside.
#pragma once
#include <complex>

namespace host {

/// Li2(z), |z| <= 1, from ln z and ln(1 - z), both principal: callers know them in polar form,
/// without the loss that z near 0 or 1 would mean. With the Bernoulli numbers B_k, either
///
///   Li2(z) = sum over k of B_k u^(k+1) / (k+1)!,  u = -ln(1 - z),
///
/// or pi^2/6 - ln z ln(1 - z) - Li2(1 - z) [Lewin 1981, 1.11 and 1.12], whichever has the shorter
/// u. It is at most pi/3 long, where the terms fall by 36: the series is cut below a quarter of an
/// epsilon, and the result good to a few of them, absolute. Real: double or long double. A z of 0
/// or 1 is given by an infinite logarithm.
template <class Real>
std::complex<Real> dilogarithm(std::complex<Real> log_z, std::complex<Real> log_complement);

extern template std::complex<double> dilogarithm(std::complex<double>, std::complex<double>);
extern template std::complex<long double> dilogarithm(std::complex<long double>,
                                                      std::complex<long double>);

}  // namespace host
