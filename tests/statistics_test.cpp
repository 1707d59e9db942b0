// Student's and Fisher's tests against printed tables, and against the report's own numbers.
#include <doctest/doctest.h>

#include <cmath>

#include "legacy/statistics.hpp"

TEST_CASE("a summary of few numbers") {
  const host::Summary s = host::summary({4, 1, 3, 2});
  CHECK(s.count == 4);
  CHECK(s.mean == 2.5);
  CHECK(s.median == 2.5);
  CHECK(s.max == 4);
  CHECK(s.min == 1);
  CHECK(s.std == doctest::Approx(std::sqrt(5.0 / 3)));
  CHECK(host::summary({5, 1, 2}).median == 2);
  CHECK(std::isnan(host::summary({}).median));
}

TEST_CASE("critical values of printed tables are rejected on one side only") {
  // t(0.975; 10) = 2.228139, F(0.975; 10, 20) = 2.773671
  const auto sample = [](double t) { return host::Summary{11, t / std::sqrt(11.0), 1, 0, 0, 0}; };
  CHECK(host::paired_t_test(sample(2.22813), 0.05).p == doctest::Approx(0.05).epsilon(1e-4));
  CHECK_FALSE(host::paired_t_test(sample(2.2281), 0.05).rejects);
  CHECK(host::paired_t_test(sample(-2.2282), 0.05).rejects);
  const host::Summary one{21, 0, 1, 0, 0, 0};
  const auto wide = [](double f) { return host::Summary{11, 0, std::sqrt(f), 0, 0, 0}; };
  CHECK(host::variance_test(wide(2.773671), one, 0.05).p == doctest::Approx(0.05).epsilon(1e-4));
  CHECK_FALSE(host::variance_test(one, wide(2.77), 0.05).rejects);
  CHECK(host::variance_test(one, wide(2.78), 0.05).rejects);
}

TEST_CASE("the report's t values follow from its means and deviations") {
  const auto t = [](double mean, double std) {
    return host::paired_t_test(host::Summary{86436, mean, std, 0, 0, 0}, 0.05);
  };
  CHECK(t(6.0358e-6, 0.0043).statistic == doctest::Approx(0.4142).epsilon(0.01));
  CHECK_FALSE(t(6.0358e-6, 0.0043).rejects);
  CHECK(t(4.1391e-4, 0.0053).statistic == doctest::Approx(22.80).epsilon(0.01));
  CHECK(t(0.0819, 0.0375).statistic == doctest::Approx(642).epsilon(0.01));
  CHECK(t(0.0819, 0.0375).p == 0);
}

TEST_CASE("samples without spread are told apart from samples that differ") {
  CHECK_FALSE(host::paired_t_test(host::summary({0, 0, 0}), 0.05).rejects);
  CHECK(host::paired_t_test(host::summary({1, 1, 1}), 0.05).rejects);
  CHECK_FALSE(host::variance_test(host::summary({1, 1}), host::summary({2, 2}), 0.05).rejects);
  CHECK(host::variance_test(host::summary({1, 2, 3}), host::summary({2, 2, 2}), 0.05).rejects);
}
