#include "score/learning_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/expect_error.hpp"
#include "support/seed.hpp"

namespace ream::score {
namespace {

using test::expect_error;

/// Science 2.3 gives s and the limits for alpha = beta = 0.1 to so many digits, and how many straight
/// successes prove proficiency.
struct Published {
  double p0, p1, s, limit;
  int successes;
};

TEST(Cusum, MatchesThePublishedNumbers) {
  for (const Published& row : {Published{0.05, 0.15, 0.0919, 1.816, 20},
                               {0.10, 0.20, 0.1452, 2.710, 19},
                               {0.20, 0.40, 0.2933, 2.240, 8}}) {
    const CusumParameters parameters{row.p0, row.p1, 0.1, 0.1};
    const CusumLimits limits = cusum_limits(parameters);
    EXPECT_NEAR(limits.success_step, -row.s, 5e-5);
    EXPECT_NEAR(limits.failure_step, 1.0 - row.s, 5e-5);
    EXPECT_NEAR(limits.proficient_at, -row.limit, 5e-4);
    EXPECT_NEAR(limits.not_proficient_at, row.limit, 5e-4);
    const auto points = cusum(parameters, std::vector<bool>(static_cast<size_t>(row.successes), true));
    for (size_t i = 0; i + 1 < points.size(); ++i) EXPECT_EQ(points[i].standing, Standing::going_on) << i;
    EXPECT_EQ(points.back().standing, Standing::proficient) << row.successes;
  }
}

/// Wald's test as it is defined: the likelihood ratio of p1 against p0, compared with (1-beta)/alpha and
/// beta/(1-alpha).
TEST(Cusum, DecidesAsTheLikelihoodRatioDoes) {
  std::mt19937 random(test::seed(91));
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int round = 0; round < 200; ++round) {
    CusumParameters p;
    p.acceptable_rate = 0.02 + 0.4 * uniform(random);
    p.unacceptable_rate = p.acceptable_rate + 0.05 + 0.4 * uniform(random);
    p.alpha = 0.01 + 0.3 * uniform(random);
    p.beta = 0.01 + 0.3 * uniform(random);
    const double failing = uniform(random);
    std::vector<bool> successes(60);
    for (size_t i = 0; i < successes.size(); ++i) successes[i] = uniform(random) >= failing;
    double ratio = 1.0;
    const auto points = cusum(p, successes);
    for (size_t i = 0; i < points.size(); ++i) {
      ratio *= successes[i] ? (1.0 - p.unacceptable_rate) / (1.0 - p.acceptable_rate)
                            : p.unacceptable_rate / p.acceptable_rate;
      const Standing expected = ratio >= (1.0 - p.beta) / p.alpha   ? Standing::not_proficient
                                : ratio <= p.beta / (1.0 - p.alpha) ? Standing::proficient
                                                                    : Standing::going_on;
      EXPECT_EQ(points[i].decided, expected) << "seed 91, round " << round << ", session " << i;
      if (expected != Standing::going_on) ratio = 1.0;
    }
  }
}

/// Wald's bounds: of those whose true failure rate is p0, at most alpha / (1 - beta) are told they are not
/// proficient; of those with p1 at most beta / (1 - alpha) that they are.
TEST(Cusum, KeepsItsErrorRates) {
  const CusumParameters p;
  const auto told_first = [&](double failing, Standing wanted) {
    std::mt19937 random(test::seed(92));
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    int told = 0;
    constexpr int trainees = 4000;
    for (int trainee = 0; trainee < trainees; ++trainee) {
      std::vector<bool> successes(200);
      for (size_t i = 0; i < successes.size(); ++i) successes[i] = uniform(random) >= failing;
      for (const CusumPoint& point : cusum(p, successes))
        if (point.decided != Standing::going_on) {
          told += point.decided == wanted ? 1 : 0;
          break;
        }
    }
    return static_cast<double>(told) / trainees;
  };
  EXPECT_LT(told_first(p.acceptable_rate, Standing::not_proficient), p.alpha / (1.0 - p.beta) + 0.01);
  EXPECT_LT(told_first(p.unacceptable_rate, Standing::proficient), p.beta / (1.0 - p.alpha) + 0.01);
  EXPECT_GT(told_first(p.acceptable_rate, Standing::proficient), 0.85);
}

TEST(Cusum, ADecisionStandsUntilTheNextAndTheSumBeginsAnew) {
  std::vector<bool> successes(8, true);  // proficient with the eighth
  successes.insert(successes.end(), {false, true, false, false, false, false});
  const auto points = cusum({}, successes);
  const CusumLimits limits = cusum_limits({});
  EXPECT_EQ(points[7].decided, Standing::proficient);
  EXPECT_DOUBLE_EQ(points[8].sum, limits.failure_step) << "from 0 again";
  EXPECT_EQ(points[8].decided, Standing::going_on);
  EXPECT_EQ(points[8].standing, Standing::proficient);
  EXPECT_EQ(points.back().standing, Standing::not_proficient);
}

TEST(Cusum, NoSessionsAreNoPoints) { EXPECT_TRUE(cusum({}, {}).empty()); }

TEST(Cusum, ImpossibleParametersAreRefused) {
  for (const CusumParameters& p : {CusumParameters{0.0, 0.4, 0.1, 0.1},
                                   {0.4, 0.4, 0.1, 0.1},
                                   {0.5, 0.4, 0.1, 0.1},
                                   {0.2, 1.0, 0.1, 0.1},
                                   {NAN, 0.4, 0.1, 0.1}})
    expect_error(ErrorKind::invalid_input, "failure rate", [&] { cusum_limits(p); });
  for (const CusumParameters& p :
       {CusumParameters{0.2, 0.4, 0.0, 0.1}, {0.2, 0.4, 0.1, 0.5}, {0.2, 0.4, NAN, 0.1}})
    expect_error(ErrorKind::invalid_input, "alpha and beta", [&] { cusum_limits(p); });
}

}  // namespace
}  // namespace ream::score
