#include "form_factor/dilogarithm.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pair_families.hpp"

namespace {

template <class Real>
std::complex<Real> li2(std::complex<Real> z) {
  return host::dilogarithm<Real>(std::log(z), std::log(Real(1) - z));
}

using Complex = std::complex<double>;

constexpr double kPi2 = std::numbers::pi * std::numbers::pi;

Complex in_disc(families::Random* random, double radius = 1) {
  return std::polar(radius * std::sqrt(random->uniform()), random->uniform(-3.2, 3.2));
}

}  // namespace

TEST_CASE("known values of the dilogarithm") {
  const double log_2 = std::numbers::ln2;
  const double golden = 1 / std::numbers::phi;
  const double log_golden2 = std::log(golden) * std::log(golden);
  const double table[][2] = {{0, 0},
                             {1, kPi2 / 6},
                             {-1, -kPi2 / 12},
                             {0.5, kPi2 / 12 - log_2 * log_2 / 2},
                             {golden, kPi2 / 10 - log_golden2},
                             {golden * golden, kPi2 / 15 - log_golden2},
                             {-golden, -kPi2 / 15 + log_golden2 / 2}};
  for (const auto& [z, expected] : table) {
    CHECK(std::abs(li2<double>(z).real() - expected) < 5e-16);
    CHECK(std::abs(li2<double>(z).imag()) < 5e-16);
  }
  const Complex i(0, 1);
  CHECK(std::abs(li2(i) - Complex(-kPi2 / 48, 0.915965594177219015)) < 4e-16);  // Catalan
  CHECK(std::abs(li2(std::polar(1.0, std::numbers::pi / 3)) -
                 Complex(kPi2 / 36, 1.014941606409653625)) < 8e-16);  // Clausen's greatest
}

TEST_CASE("series of powers near zero") {
  families::Random random(91);
  for (int draw = 0; draw < 2000; ++draw) {
    const Complex z = in_disc(&random, 0.4);
    Complex power = z;
    Complex sum = 0;
    for (int k = 1; k <= 45; ++k) {
      sum += power / double(k * k);
      power *= z;
    }
    CHECK(std::abs(li2(z) - sum) <= 4e-16);
  }
}

TEST_CASE("functional equations on random complex arguments") {
  families::Random random(92);
  double duplication = 0, reflection = 0, landen = 0, five_terms = 0;
  int reflected = 0, landed = 0;
  for (int draw = 0; draw < 20000; ++draw) {
    const Complex z = in_disc(&random);
    const auto worst = [](double* most, const Complex& defect) {
      *most = std::max(*most, std::abs(defect));
    };
    worst(&duplication, li2(z) + li2(-z) - 0.5 * li2(z * z));
    if (std::abs(1.0 - z) <= 1) {
      ++reflected;
      worst(&reflection, li2(z) + li2(1.0 - z) - (kPi2 / 6 - std::log(z) * std::log(1.0 - z)));
    }
    if (z.real() <= 0.5) {  // z / (z - 1) is in the disc, too
      ++landed;
      const Complex log_complement = std::log(1.0 - z);
      worst(&landen, li2(z) + li2(z / (z - 1.0)) + 0.5 * log_complement * log_complement);
    }
    // Abel's equation, small enough for its products and quotients to stay in the disc.
    const Complex x = in_disc(&random, 0.5), y = in_disc(&random, 0.5);
    worst(&five_terms, li2(x / (1.0 - y)) + li2(y / (1.0 - x)) - li2(x) - li2(y) -
                           li2(x * y / ((1.0 - x) * (1.0 - y))) -
                           std::log(1.0 - x) * std::log(1.0 - y));
  }
  CHECK(reflected > 5000);
  CHECK(landed > 10000);
  CHECK(duplication < 2e-15);
  CHECK(reflection < 2e-15);
  CHECK(landen < 2e-15);
  CHECK(five_terms < 4e-15);
}

TEST_CASE("both precisions agree, on the rim and where the two series meet") {
  families::Random random(93);
  double worst = 0;
  for (int draw = 0; draw < 20000; ++draw) {
    const double radius = draw % 2 ? 1 : random.log_uniform(1e-6, 1);
    const std::complex<long double> z =
        std::polar<long double>(radius, draw % 3 ? random.uniform(-3.2, 3.2)
                                                 : std::numbers::pi / 3 + 1e-3 * random.uniform());
    const Complex rounded(z);
    worst = std::max(worst, double(std::abs(std::complex<long double>(li2(rounded)) -
                                            li2(std::complex<long double>(rounded)))));
  }
  CHECK(worst < 1e-15);
}
