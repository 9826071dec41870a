#include "study/feel_trials.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "support/expect_error.hpp"

namespace ream::study {
namespace {

using nlohmann::json;

const FeelTrials all_of_them = feel_trials_from(json::object());

TEST(FeelTrials, AllComparisonsComeWhereNoneAreNamed) {
  EXPECT_EQ(all_of_them.comparisons.size(), case_::plate_comparisons().size());
  EXPECT_EQ(all_of_them.trials_per_comparison, 8);
  const json written = to_json(all_of_them);
  EXPECT_EQ(to_json(feel_trials_from(written)), written);
  test::expect_error(ErrorKind::invalid_input, "twice", [] {
    feel_trials_from({{"comparisons", {"density", "density"}}});
  });
}

TEST(FeelTrials, TheRightAnswerIsAsOftenUpperAsLowerInEachComparison) {
  for (const char* code : {"K7-F3M", "AA-222", "ZZ-999"}) {
    std::map<std::string, std::map<bool, int>> counts;
    int number = 0;
    for (const FeelTrial& trial : trials_for(all_of_them, "seed", code)) {
      ++counts[trial.comparison->id][trial.asked_for_is_upper];
      EXPECT_EQ(trial.number, ++number);
      EXPECT_EQ(trial.of, 32);
      EXPECT_EQ(trial.right_answer(), std::string(trial.asked_for_is_upper ? "upper" : "lower"));
    }
    for (const auto& [comparison, sides] : counts) {
      EXPECT_EQ(sides.at(true), 4) << comparison;
      EXPECT_EQ(sides.at(false), 4) << comparison;
    }
  }
}

TEST(FeelTrials, OrdersAreTheParticipantsOwnAndComeAgain) {
  const auto order = [](const std::string& seed, const std::string& code) {
    std::string cases;
    for (const FeelTrial& trial : trials_for(all_of_them, seed, code)) cases += trial.case_id() + " ";
    return cases;
  };
  EXPECT_EQ(order("seed", "K7-F3M"), order("seed", "K7-F3M"));
  EXPECT_NE(order("seed", "K7-F3M"), order("seed", "K7-F3N"));
  EXPECT_NE(order("seed", "K7-F3M"), order("other", "K7-F3M"));
}

TEST(FeelTrials, EveryPlaceHasEveryTrialEquallyOften) {
  // Over 4,000 participants the first trial's right answer is upper in half of them, and each comparison
  // comes first in a quarter: chi square of 8 cells, 7 degrees of freedom, 24.3 is passed once in a thousand
  // times.
  FeelTrials few = all_of_them;
  few.trials_per_comparison = 2;
  std::map<std::string, int> first, last;
  constexpr int persons = 4000;
  for (int i = 0; i < persons; ++i) {
    const auto trials = trials_for(few, "seed", "P" + std::to_string(i));
    ++first[trials.front().case_id()];
    ++last[trials.back().case_id()];
  }
  for (const auto& counts : {first, last}) {
    double chi_square = 0.0;
    ASSERT_EQ(counts.size(), 8u);
    for (const auto& [id, count] : counts) {
      const double expected = persons / 8.0;
      chi_square += (count - expected) * (count - expected) / expected;
    }
    EXPECT_LT(chi_square, 24.3);
  }
}

}  // namespace
}  // namespace ream::study
