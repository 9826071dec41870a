#pragma once
#include <span>
#include <vector>

#include "statistics/estimate.hpp"

namespace ream::statistics {

/// A difference of means and the chance of one as large, either way, where there is none.
struct MeanDifference {
  double difference = 0.0;
  double t = 0.0, freedom = 0.0;
  double p = 1.0;
  Interval interval;
};

/// First less second, without the assumption of equal variances (Welch 1947, "The generalization of Student's
/// problem", Biometrika 34). Two values or more in each group, not all equal within both.
Answer<MeanDifference> welch_test(std::span<const double> first, std::span<const double> second,
                                  double confidence = 0.95);

/// Mean of what each gained, after less before (Student 1908). As many values before as after, in the same
/// order; two pairs or more, with gains that differ by more than rounding (1e-10 of the largest value).
Answer<MeanDifference> paired_test(std::span<const double> before, std::span<const double> after,
                                   double confidence = 0.95);

/// Values of an arm before and after, in the same order.
struct ArmValues {
  std::vector<double> before, after;
};

/// How much more the first arm gained than the second: welch_test of the gains.
Answer<MeanDifference> difference_in_change(const ArmValues& first, const ArmValues& second,
                                            double confidence = 0.95);

/// The same from after = a + b before + effect (1 in the first arm), by least squares: what is left of the
/// difference after, when the arms are compared at equal values before (Fisher 1932; Vickers & Altman 2001,
/// BMJ 323). n1 + n2 - 3 degrees of freedom; two in each arm and four in all, with values before that differ
/// within an arm.
Answer<MeanDifference> covariance_adjusted(const ArmValues& first, const ArmValues& second,
                                           double confidence = 0.95);

}  // namespace ream::statistics
