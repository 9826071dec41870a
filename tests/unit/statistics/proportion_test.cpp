#include "statistics/proportion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "statistics/distributions.hpp"
#include "support/expect_error.hpp"

namespace ream::statistics {
namespace {

TEST(Proportion, MendelsPeasOfConover) {
  // 682 of 925 against three quarters: p 0.3825, interval 0.7076683 to 0.7654066 (R's binom.test).
  const auto test = binomial_test(682, 925, 0.75);
  ASSERT_TRUE(test);
  EXPECT_NEAR(test->p_two_sided, 0.3825, 0.00005);
  EXPECT_NEAR(test->interval.low, 0.7076683, 1e-7);
  EXPECT_NEAR(test->interval.high, 0.7654066, 1e-7);
}

TEST(Proportion, AnExactTestCountedByHand) {
  // Of ten coins nine or ten are heads in 11 of 1024 cases.
  const auto test = binomial_test(9, 10);
  EXPECT_NEAR(test->p_greater, 11.0 / 1024.0, 1e-12);
  EXPECT_NEAR(test->p_two_sided, 22.0 / 1024.0, 1e-12);
  EXPECT_EQ(binomial_test(0, 10)->p_greater, 1.0);
  EXPECT_NEAR(binomial_test(5, 10)->p_two_sided, 1.0, 1e-12);
}

TEST(Proportion, TheIntervalsOfNoneAndAll) {
  const Interval none = clopper_pearson_interval(0, 10), all = clopper_pearson_interval(10, 10);
  EXPECT_EQ(none.low, 0.0);
  EXPECT_NEAR(none.high, 1.0 - std::pow(0.025, 0.1), 1e-12);
  EXPECT_EQ(all.high, 1.0);
  EXPECT_NEAR(all.low, std::pow(0.025, 0.1), 1e-12);
  // Wilson's of none: z^2 / (n + z^2).
  const double z = normal_quantile(0.975);
  EXPECT_NEAR(wilson_interval(0, 10).high, z * z / (10.0 + z * z), 1e-12);
  EXPECT_EQ(wilson_interval(0, 10).low, 0.0);
}

TEST(Proportion, WilsonsBoundsAreWhereTheScoreTestJustDoesNotReject) {
  const double z = normal_quantile(0.975);
  for (const size_t hits : {1u, 7u, 19u}) {
    const Interval interval = wilson_interval(hits, 20);
    for (const double bound : {interval.low, interval.high})
      EXPECT_NEAR(
          std::abs(static_cast<double>(hits) / 20.0 - bound) / std::sqrt(bound * (1.0 - bound) / 20.0), z,
          1e-9);
  }
}

TEST(Proportion, ClopperAndPearsonNeverCoverLess) {
  for (const double truth : {0.05, 0.3, 0.5, 0.77}) {
    double covered = 0.0;
    for (size_t k = 0; k <= 30; ++k) {
      const Interval interval = clopper_pearson_interval(k, 30);
      if (interval.low <= truth && truth <= interval.high) covered += binomial_density(k, 30, truth);
    }
    EXPECT_GE(covered, 0.95) << truth;
  }
}

TEST(Proportion, TwoChoicesGiveDPrime) {
  // A share of Phi(1 / sqrt 2) = 0.7602 is d' = 1: 76 of 100 are just below.
  EXPECT_NEAR(d_prime_of_share(0.76), 0.9989, 0.0001);
  EXPECT_EQ(d_prime_of_share(0.5), 0.0);
  EXPECT_NEAR(d_prime_of_share(0.24), -d_prime_of_share(0.76), 1e-12);
}

TEST(Proportion, CountsThatCannotBeAreRefused) {
  test::expect_error(ErrorKind::invalid_input, "no more successes", [] { wilson_interval(3, 2); });
  test::expect_error(ErrorKind::invalid_input, "one trial", [] { clopper_pearson_interval(0, 0); });
  test::expect_error(ErrorKind::invalid_input, "between 0 and 1", [] { (void)binomial_test(1, 2, 1.0); });
  EXPECT_EQ(binomial_test(0, 0).note, "no trial");
}

}  // namespace
}  // namespace ream::statistics
