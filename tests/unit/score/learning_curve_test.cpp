#include "score/learning_curve.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace ream::score {
namespace {

LearningPoint session(std::optional<Outcome> outcome) {
  LearningPoint point;
  point.session = "s";
  point.points = 50.0;
  point.outcome = outcome;
  return point;
}

TEST(LearningCurve, CountsOnlySessionsThatWereDecided) {
  const LearningCurve curve = learning_curve({}, {session(Outcome::pass), session(Outcome::undecided),
                                                  session(std::nullopt), session(Outcome::fail)});
  const CusumLimits limits = cusum_limits({});
  EXPECT_DOUBLE_EQ(curve.points[0].cusum->sum, limits.success_step);
  EXPECT_FALSE(curve.points[1].cusum);
  EXPECT_FALSE(curve.points[2].cusum);
  EXPECT_DOUBLE_EQ(curve.points[3].cusum->sum, limits.success_step + limits.failure_step);
  EXPECT_EQ(curve.standing(), Standing::going_on);
}

TEST(LearningCurve, TellsHowManyPassesAreToGo) {
  EXPECT_EQ(learning_curve({}, {}).passes_to_go(), 8) << "20/40 % takes eight straight successes";
  EXPECT_EQ(learning_curve({}, std::vector(3, session(Outcome::pass))).passes_to_go(), 5);
  const LearningCurve proven = learning_curve({}, std::vector(8, session(Outcome::pass)));
  EXPECT_EQ(proven.standing(), Standing::proficient);
  EXPECT_EQ(proven.passes_to_go(), 8) << "the sum has begun again";
  // A failure weighs 0.7067, a success 0.2933: three more successes than without it.
  EXPECT_EQ(learning_curve({}, {session(Outcome::fail)}).passes_to_go(), 11);
}

TEST(LearningCurve, IsToldAsJson) {
  const nlohmann::json told =
      learning_json(learning_curve({}, {session(Outcome::pass), session(Outcome::undecided)}));
  EXPECT_EQ(told["standing"], "going on");
  EXPECT_EQ(told["sessions"].size(), 2u);
  EXPECT_TRUE(told["sessions"][1]["cusum"].is_null());
  EXPECT_EQ(told["sessions"][1]["outcome"], "undecided");
  EXPECT_NEAR(told["proficient_at"].get<double>(), -2.240, 5e-4);
}

}  // namespace
}  // namespace ream::score
