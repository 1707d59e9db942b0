#include "legacy/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

namespace host {

Summary summary(std::vector<double> values) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (values.empty()) return {0, none, none, none, none, none};
  Summary result;
  result.count = values.size();
  const double n = double(values.size());
  for (const double x : values) result.mean += x / n;
  double squares = 0;
  for (const double x : values) squares += (x - result.mean) * (x - result.mean);
  result.std = values.size() > 1 ? std::sqrt(squares / (n - 1)) : 0;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  result.median = values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
  result.min = values.front();
  result.max = values.back();
  return result;
}

TestResult paired_t_test(const Summary& differences, double level) {
  TestResult result;
  if (differences.count < 2 || !(differences.std > 0)) {
    const bool off = differences.count > 1 && differences.mean != 0;
    result.statistic = off ? std::numeric_limits<double>::infinity() : 0;
    result.p = off ? 0 : 1;
  } else {
    const double n = double(differences.count);
    result.statistic = differences.mean / (differences.std / std::sqrt(n));
    const boost::math::students_t distribution(n - 1);
    result.p =
        2 * boost::math::cdf(boost::math::complement(distribution, std::fabs(result.statistic)));
  }
  result.rejects = result.p < level;
  return result;
}

TestResult variance_test(const Summary& a, const Summary& b, double level) {
  const bool a_wider = a.std >= b.std;
  const Summary &wide = a_wider ? a : b, &close = a_wider ? b : a;
  TestResult result;
  if (wide.count < 2 || close.count < 2) return result;
  if (!(close.std > 0)) {
    const bool off = wide.std > 0;
    result.statistic = off ? std::numeric_limits<double>::infinity() : 1;
    result.p = off ? 0 : 1;
  } else {
    result.statistic = (wide.std / close.std) * (wide.std / close.std);
    const boost::math::fisher_f distribution(double(wide.count) - 1, double(close.count) - 1);
    result.p = std::min(
        1.0, 2 * boost::math::cdf(boost::math::complement(distribution, result.statistic)));
  }
  result.rejects = result.p < level;
  return result;
}

}  // namespace host
