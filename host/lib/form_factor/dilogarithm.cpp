#include "form_factor/dilogarithm.hpp"

#include <array>
#include <limits>
#include <numbers>

namespace host {
namespace {

constexpr std::size_t kMostTerms = 13;

/// B_2k / (2k + 1)!, k = 1, 2, ...
constexpr std::array<long double, kMostTerms> kCoefficients = [] {
  constexpr std::array<long double, kMostTerms> bernoulli = {
      1.0L / 6,       -1.0L / 30,       1.0L / 42,       -1.0L / 30,
      5.0L / 66,      -691.0L / 2730,   7.0L / 6,        -3617.0L / 510,
      43867.0L / 798, -174611.0L / 330, 854513.0L / 138, -236364091.0L / 2730,
      8553103.0L / 6};
  std::array<long double, kMostTerms> result{};
  long double factorial = 1;
  for (std::size_t k = 1; k <= kMostTerms; ++k) {
    factorial *= static_cast<long double>(2 * k) * static_cast<long double>(2 * k + 1);
    result[k - 1] = bernoulli[k - 1] / factorial;
  }
  return result;
}();

/// Terms that |u| = pi/3 needs: the k-th is about 2/(2k + 1) 6^(-2k) of the first.
template <class Real>
constexpr std::size_t kTerms = std::numeric_limits<Real>::digits <= 53 ? 10 : kMostTerms;

template <class Real>
constexpr std::array<Real, kTerms<Real>> coefficients() {
  std::array<Real, kTerms<Real>> result{};
  for (std::size_t k = 0; k < result.size(); ++k) result[k] = static_cast<Real>(kCoefficients[k]);
  return result;
}

// Products by hand: std::complex also looks after infinities, which do not get here.
template <class Real>
std::complex<Real> product(std::complex<Real> a, std::complex<Real> b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// Li2(1 - exp(-u)). The polynomial in v = u^2 has real coefficients: modulo v^2 - 2 Re(v) v +
/// |v|^2 it takes two real products per term [Knuth, 4.6.4].
template <class Real>
std::complex<Real> series(std::complex<Real> u) {
  static constexpr std::array<Real, kTerms<Real>> c = coefficients<Real>();
  const std::complex<Real> v = product(u, u);
  const Real twice = 2 * v.real();
  const Real norm = v.real() * v.real() + v.imag() * v.imag();
  Real high = c[c.size() - 1];
  Real low = c[c.size() - 2];
  for (std::size_t k = c.size() - 2; k-- > 0;) {
    const Real next = c[k] - norm * high;
    high = low + twice * high;
    low = next;
  }
  // high v + low, then u (1 + v (high v + low)) - v / 4.
  const std::complex<Real> rest = product(v, {high * v.real() + low, high * v.imag()});
  const std::complex<Real> odd = product(u, {1 + rest.real(), rest.imag()});
  return {odd.real() - v.real() / 4, odd.imag() - v.imag() / 4};
}

template <class Real>
Real squared(std::complex<Real> z) {
  return z.real() * z.real() + z.imag() * z.imag();
}

}  // namespace

template <class Real>
std::complex<Real> dilogarithm(std::complex<Real> log_z, std::complex<Real> log_complement) {
  constexpr Real kLi2Of1 = std::numbers::pi_v<Real> * std::numbers::pi_v<Real> / 6;
  if (log_z == Real(0)) return kLi2Of1;  // where ln(1 - z) is infinite
  // Chosen number by number: no branch, which would be taken at random.
  const bool direct = squared(log_complement) <= squared(log_z);
  const std::complex<Real> sum = series<Real>({direct ? -log_complement.real() : -log_z.real(),
                                               direct ? -log_complement.imag() : -log_z.imag()});
  const std::complex<Real> both = product(log_z, log_complement);
  return {direct ? sum.real() : kLi2Of1 - both.real() - sum.real(),
          direct ? sum.imag() : -both.imag() - sum.imag()};
}

template std::complex<double> dilogarithm(std::complex<double>, std::complex<double>);
template std::complex<long double> dilogarithm(std::complex<long double>,
                                               std::complex<long double>);

}  // namespace host
