// The report's statistics: summaries, the paired t test, the F test on variances.
#pragma once
#include <vector>

namespace host {

struct Summary {
  std::size_t count = 0;
  double mean = 0, std = 0;  ///< std of a sample (n - 1)
  double median = 0, max = 0, min = 0;
};

/// NaN fields for an empty sample.
Summary summary(std::vector<double> values);

struct TestResult {
  double statistic = 0;
  double p = 1;
  bool rejects = false;  ///< p < the level asked for
};

/// Two-tailed, paired: are `differences` 0 on average?
TestResult paired_t_test(const Summary& differences, double level);

/// Two-tailed: have the two samples one variance? statistic: the larger variance over the smaller.
TestResult variance_test(const Summary& a, const Summary& b, double level);

}  // namespace host
