#pragma once
#include <cstddef>

#include "statistics/estimate.hpp"

namespace ream::statistics {

/// Interval of a share (Wilson 1927), also of none and of all. `trials` is over 0.
Interval wilson_interval(size_t successes, size_t trials, double confidence = 0.95);

/// Interval of a share that never covers less than it says (Clopper & Pearson 1934), by quantiles of beta.
Interval clopper_pearson_interval(size_t successes, size_t trials, double confidence = 0.95);

/// Exact test of a share against one that is expected.
struct BinomialTest {
  double share = 0.0;
  double p_greater = 1.0;    ///< chance of as many successes or more
  double p_two_sided = 1.0;  ///< chance of all numbers of successes that are no likelier than this one
  Interval interval;         ///< Clopper & Pearson
};
/// Error invalid_input unless successes <= trials and `expected` lies between 0 and 1.
Answer<BinomialTest> binomial_test(size_t successes, size_t trials, double expected = 0.5,
                                   double confidence = 0.95);

/// Sensitivity of somebody who chooses one of two, without bias to a side: d' = sqrt(2) z(share of right
/// choices) (Green & Swets 1966; Macmillan & Creelman, Detection Theory, chapter 7); infinite at 0 and 1.
double d_prime_of_share(double right);

}  // namespace ream::statistics
