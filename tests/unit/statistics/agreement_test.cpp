#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "statistics/intraclass.hpp"
#include "statistics/kappa.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"

namespace ream::statistics {
namespace {

using Counts = std::vector<std::vector<size_t>>;

/// Six subjects, four judges: table 2 of Shrout & Fleiss 1979.
const std::vector<RatingRow> six_by_four = {{9, 2, 5, 8}, {6, 1, 3, 2},  {8, 4, 6, 8},
                                            {7, 1, 2, 6}, {10, 5, 6, 9}, {6, 2, 4, 7}};

TEST(IntraclassCorrelation, SixSubjectsByFourJudgesOfShroutAndFleiss) {
  const auto icc = intraclass_correlation(six_by_four);
  ASSERT_TRUE(icc);
  // Their table 3: mean squares 11.24, 32.49, 1.02; table 4: ICC(2,1) 0.29, ICC(2,4) 0.62.
  EXPECT_NEAR(icc->subject_square, 11.24, 0.005);
  EXPECT_NEAR(icc->rater_square, 32.49, 0.005);
  EXPECT_NEAR(icc->error_square, 1.02, 0.005);
  EXPECT_NEAR(icc->single, 0.29, 0.005);
  EXPECT_NEAR(icc->average, 0.62, 0.005);
  // As R's package psych prints for the same table.
  ASSERT_TRUE(icc->single_interval && icc->average_interval);
  EXPECT_NEAR(icc->single_interval->low, 0.019, 0.0005);
  EXPECT_NEAR(icc->single_interval->high, 0.76, 0.005);
  EXPECT_NEAR(icc->average_interval->low, 0.071, 0.001);
  EXPECT_NEAR(icc->average_interval->high, 0.93, 0.005);
}

TEST(IntraclassCorrelation, SubjectsWithAMissingRatingAreDroppedAndCounted) {
  std::vector<RatingRow> table = six_by_four;
  table.push_back({9, std::nullopt, 5, 8});
  const auto icc = intraclass_correlation(table), whole = intraclass_correlation(six_by_four);
  EXPECT_EQ(icc->dropped, 1u);
  EXPECT_EQ(icc->subjects, 6u);
  EXPECT_EQ(icc->single, whole->single);
}

TEST(IntraclassCorrelation, AnIntervalThatReachesTheLeastValueHasNoneOfTheMean) {
  // Mean squares 2/3, 1/6 and 2/3: both ICCs are 0, with two degrees of freedom for the interval's F.
  // The 97.5 % of F(2, 2) is 39, so that the bounds are -76 / 41, under the least value -1, and 76 / 79.
  const auto icc = intraclass_correlation({{2, 3}, {3, 2}, {3, 4}});
  ASSERT_TRUE(icc && icc->single_interval);
  EXPECT_NEAR(icc->single, 0.0, 1e-12);
  EXPECT_NEAR(icc->average, 0.0, 1e-12);
  EXPECT_EQ(icc->single_interval->low, -1.0);
  EXPECT_NEAR(icc->single_interval->high, 76.0 / 79.0, 1e-9);
  EXPECT_FALSE(icc->average_interval);
  EXPECT_NE(icc.note.find("has no interval"), std::string::npos) << icc.note;
}

TEST(IntraclassCorrelation, RatingsThatDifferAreNotSaidToBeEqual) {
  const auto crossed = intraclass_correlation({{1, 2}, {2, 1}, {1.5, 1.5}});
  EXPECT_FALSE(crossed);
  EXPECT_EQ(crossed.note.find("do not differ"), std::string::npos) << crossed.note;
  EXPECT_NE(crossed.note.find("less than chance"), std::string::npos) << crossed.note;
  const std::vector<RatingRow> equal(7, RatingRow(3, 1.87));
  EXPECT_NE(intraclass_correlation(equal).note.find("do not differ"), std::string::npos);
}

TEST(IntraclassCorrelation, WhatCannotBeSaidIsAnsweredInWords) {
  EXPECT_EQ(intraclass_correlation({}).note, "agreement needs two raters or more");
  EXPECT_EQ(intraclass_correlation({{1}, {2}}).note, "agreement needs two raters or more");
  EXPECT_NE(intraclass_correlation({{1, 2}, {2, std::nullopt}}).note.find("two subjects"), std::string::npos);
  EXPECT_NE(intraclass_correlation({{3, 3}, {3, 3}, {3, 3}}).note.find("do not differ"), std::string::npos);
  const auto equal = intraclass_correlation({{1, 1}, {2, 2}, {4, 4}});
  EXPECT_NEAR(equal->single, 1.0, 1e-12);
  EXPECT_FALSE(equal->single_interval);
  // A rater who always says one more agrees less than wholly.
  const auto shifted = intraclass_correlation({{1, 2}, {2, 3}, {4, 5}});
  EXPECT_LT(shifted->single, 1.0);
  EXPECT_FALSE(shifted->single_interval);
  test::expect_error(ErrorKind::invalid_input, "raters", [] { intraclass_correlation({{1, 2}, {2}}); });
}

TEST(IntraclassCorrelation, ItsIntervalHoldsTheTruth) {
  // Variances of subjects, raters and error 4, 0.5 and 1.5: agreement of one rater is 4 / 6.
  std::mt19937 random(test::seed(72));
  std::normal_distribution<double> bell;
  int held = 0;
  constexpr int trials = 2000;
  for (int trial = 0; trial < trials; ++trial) {
    std::array<double, 5> rater;
    for (double& r : rater) r = std::sqrt(0.5) * bell(random);
    std::vector<RatingRow> table;
    for (int subject = 0; subject < 15; ++subject) {
      const double truth = 2.0 * bell(random);
      RatingRow row;
      for (const double r : rater) row.emplace_back(truth + r + std::sqrt(1.5) * bell(random));
      table.push_back(row);
    }
    const auto icc = intraclass_correlation(table);
    held += icc->single_interval->low <= 2.0 / 3.0 && 2.0 / 3.0 <= icc->single_interval->high ? 1 : 0;
  }
  EXPECT_NEAR(held / static_cast<double>(trials), 0.95, 0.025);
}

TEST(Kappa, TheTableOfFleissCohenAndEveritt) {
  // Psychol Bull 1969, 72, 323: shares of 200 subjects times 100.
  const Counts table = {{106, 10, 4}, {22, 28, 10}, {2, 12, 6}};
  const auto kappa = cohens_kappa(table);
  ASSERT_TRUE(kappa);
  EXPECT_NEAR(kappa->observed, 0.70, 1e-12);
  EXPECT_NEAR(kappa->expected, 0.475, 1e-12);
  EXPECT_NEAR(kappa->kappa, 0.429, 0.0005);
  EXPECT_NEAR(*kappa->standard_error * *kappa->standard_error, 0.002885, 0.000002);
}

TEST(Kappa, TheTableOfFleissBook) {
  // Statistical Methods for Rates and Proportions, table 13.1 of the second edition: kappa 0.68, error 0.087.
  const auto kappa = cohens_kappa({{75, 1, 4}, {5, 4, 1}, {0, 0, 10}});
  EXPECT_NEAR(kappa->kappa, 0.676, 0.0005);
  EXPECT_NEAR(*kappa->standard_error, 0.087, 0.0009);
}

TEST(Kappa, WeightsCountNearMisses) {
  const Counts table = {{10, 4, 1}, {3, 12, 5}, {0, 2, 13}};
  // With two categories all weights are the same; with three, quadratic weights of neighbours are 3/4.
  const Counts two = {{10, 4}, {3, 12}};
  EXPECT_DOUBLE_EQ(cohens_kappa(two)->kappa, cohens_kappa(two, KappaWeights::quadratic)->kappa);
  EXPECT_DOUBLE_EQ(*cohens_kappa(two)->standard_error,
                   *cohens_kappa(two, KappaWeights::linear)->standard_error);
  const double plain = cohens_kappa(table)->kappa, linear = cohens_kappa(table, KappaWeights::linear)->kappa,
               quadratic = cohens_kappa(table, KappaWeights::quadratic)->kappa;
  EXPECT_LT(plain, linear);
  EXPECT_LT(linear, quadratic);
  EXPECT_NEAR(cohens_kappa(table, KappaWeights::quadratic)->observed, (35.0 + 0.75 * 14.0) / 50.0, 1e-12);
}

/// Kappa by its definition: disagreement seen over that of chance.
double kappa_by_disagreement(const std::vector<std::vector<double>>& share, bool quadratic) {
  double seen = 0.0, chance = 0.0;
  const size_t c = share.size();
  std::vector<double> row(c, 0.0), column(c, 0.0);
  for (size_t i = 0; i < c; ++i)
    for (size_t j = 0; j < c; ++j) {
      row[i] += share[i][j];
      column[j] += share[i][j];
    }
  for (size_t i = 0; i < c; ++i)
    for (size_t j = 0; j < c; ++j) {
      const double apart = std::abs(static_cast<double>(i) - static_cast<double>(j));
      const double cost = quadratic ? apart * apart : apart;
      seen += cost * share[i][j];
      chance += cost * row[i] * column[j];
    }
  return 1.0 - seen / chance;
}

TEST(Kappa, ItsErrorIsThatOfTheDeltaMethod) {
  const Counts table = {{20, 5, 2, 0}, {4, 15, 6, 1}, {1, 4, 18, 5}, {0, 1, 3, 15}};
  for (const bool quadratic : {false, true}) {
    std::vector<std::vector<double>> share(4, std::vector<double>(4));
    for (size_t i = 0; i < 4; ++i)
      for (size_t j = 0; j < 4; ++j) share[i][j] = static_cast<double>(table[i][j]) / 100.0;
    double squares = 0.0, mean = 0.0;
    for (size_t i = 0; i < 4; ++i)
      for (size_t j = 0; j < 4; ++j) {
        auto more = share, less = share;
        more[i][j] += 1e-6;
        less[i][j] -= 1e-6;
        // The definition is not homogeneous in the shares; what that adds is the same in every cell and goes.
        const double slope =
            (kappa_by_disagreement(more, quadratic) - kappa_by_disagreement(less, quadratic)) / 2e-6;
        squares += share[i][j] * slope * slope;
        mean += share[i][j] * slope;
      }
    const auto kappa = cohens_kappa(table, quadratic ? KappaWeights::quadratic : KappaWeights::linear);
    EXPECT_NEAR(kappa->kappa, kappa_by_disagreement(share, quadratic), 1e-12);
    EXPECT_NEAR(*kappa->standard_error, std::sqrt((squares - mean * mean) / 100.0), 1e-7);
  }
}

/// Ten subjects, fourteen raters, five categories, as in many introductions to Fleiss' kappa.
const Counts ten_by_fourteen = {{0, 0, 0, 0, 14}, {0, 2, 6, 4, 2}, {0, 0, 3, 5, 6}, {0, 3, 9, 2, 0},
                                {2, 2, 8, 1, 1},  {7, 7, 0, 0, 0}, {3, 2, 6, 3, 0}, {2, 5, 3, 2, 2},
                                {6, 5, 2, 1, 0},  {0, 2, 2, 3, 7}};

TEST(Kappa, OfManyRaters) {
  const auto kappa = fleiss_kappa(ten_by_fourteen);
  ASSERT_TRUE(kappa && kappa->interval);
  EXPECT_NEAR(kappa->observed, 0.378, 0.0005);
  EXPECT_NEAR(kappa->expected, 0.213, 0.0005);
  EXPECT_NEAR(kappa->kappa, 0.210, 0.0005);
}

TEST(Kappa, TheIntervalOfManyRatersHoldsTheTruth) {
  // Subjects are "yes" with chance 1/2; each of four raters says so with chance 0.85 if they are, 0.15 if
  // not: kappa is (0.85 - 0.15)^2 = 0.49.
  std::mt19937 random(test::seed(73));
  int held = 0;
  constexpr int trials = 2000;
  for (int trial = 0; trial < trials; ++trial) {
    Counts counts;
    for (int subject = 0; subject < 40; ++subject) {
      const double chance = std::bernoulli_distribution(0.5)(random) ? 0.85 : 0.15;
      const auto yes = static_cast<size_t>(std::binomial_distribution<int>(4, chance)(random));
      counts.push_back({4 - yes, yes});
    }
    const Interval interval = *fleiss_kappa(counts)->interval;
    held += interval.low <= 0.49 && 0.49 <= interval.high ? 1 : 0;
  }
  EXPECT_NEAR(held / static_cast<double>(trials), 0.95, 0.025);
}

TEST(Kappa, ItsIntervalEndsAtOneAndMinusOne) {
  const auto high = cohens_kappa({{9, 1}, {0, 2}}), low = cohens_kappa({{0, 6}, {6, 1}});
  ASSERT_TRUE(high->interval && low->interval);
  EXPECT_EQ(high->interval->high, 1.0);
  EXPECT_GT(high->kappa + 1.96 * *high->standard_error, 1.0);
  EXPECT_EQ(low->interval->low, -1.0);
  EXPECT_LT(low->kappa - 1.96 * *low->standard_error, -1.0);
}

TEST(Kappa, WhatCannotBeSaidIsAnsweredInWords) {
  EXPECT_NE(cohens_kappa({{9, 0}, {0, 0}}).note.find("every rating is the same"), std::string::npos);
  EXPECT_NE(fleiss_kappa({{3, 0}, {3, 0}}).note.find("every rating is the same"), std::string::npos);
  EXPECT_NE(cohens_kappa({{1, 0}, {0, 0}}).note.find("two subjects"), std::string::npos);
  const auto whole = cohens_kappa({{5, 0}, {0, 5}});
  EXPECT_DOUBLE_EQ(whole->kappa, 1.0);
  EXPECT_FALSE(whole->interval);
  test::expect_error(ErrorKind::invalid_input, "as many rows", [] { cohens_kappa({{1, 2}, {3}}); });
  test::expect_error(ErrorKind::invalid_input, "as many raters", [] { fleiss_kappa({{1, 2}, {3, 1}}); });
}

}  // namespace
}  // namespace ream::statistics
