#include "score/rubric_score.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace ream::score {
namespace {

Rubric rubric(const nlohmann::json& criteria, std::optional<double> pass_points = std::nullopt) {
  nlohmann::json value = {{"name", "first year"}, {"version", 3}, {"criteria", criteria}};
  if (pass_points) value["pass_points"] = *pass_points;
  return rubric_from_json(value, "rubric");
}

nlohmann::json limited(const char* metric, bool critical = false, double weight = 1.0) {
  return {{"metric", metric},
          {"critical", critical},
          {"weight", weight},
          {"band", {{"better", "less"}, {"pass", 2.0}, {"warn", 4.0}}}};
}

TEST(RubricScore, IsTheWeightedMeanOfWhatIsSaid) {
  const nlohmann::json metrics = {{"thrust_n", 60.0},
                                  {"depth_mm", 1.5},
                                  {"missing_n", nullptr},
                                  {"missing", {{"missing_n", "nobody knows"}}}};
  const Rubric r = rubric({{{"metric", "thrust_n"}, {"none", 100}, {"full", 20}, {"weight", 3}},
                           {{"metric", "depth_mm"}, {"none", 0}, {"full", 2}},
                           {{"metric", "missing_n"}, {"none", 0}, {"full", 1}, {"weight", 4}}});
  const Score score = apply_rubric(r, metrics);
  EXPECT_DOUBLE_EQ(*score.points, 56.2) << "(3 * 50 + 75) / 4 = 56.25, rounded down to a tenth";
  EXPECT_DOUBLE_EQ(score.measured_percent, 50.0);
  EXPECT_FALSE(score.criteria[2].points) << "no points for what the session does not say";
  EXPECT_EQ(score.criteria[2].missing_reason, "nobody knows");
  EXPECT_FALSE(score.outcome) << "the rubric has neither mark nor critical criteria";
  const nlohmann::json told = score_json(r, score);
  EXPECT_EQ(told["rubric"], "first year");
  EXPECT_EQ(told["version"], 3);
  EXPECT_EQ(told["hash"].get<std::string>().size(), 16u);
  EXPECT_TRUE(told["criteria"][2]["points"].is_null());
  EXPECT_TRUE(told["outcome"].is_null());
}

TEST(RubricScore, BandsGivePointsAndVerdicts) {
  const auto at = [](const nlohmann::json& criterion, double value) {
    const Rubric r = rubric(nlohmann::json::array({criterion}));
    return std::pair(points_of(r.criteria[0], value), verdict(r.criteria[0].judged_by(), value));
  };
  const nlohmann::json less = limited("x");
  EXPECT_EQ(at(less, 2.0), std::pair(100.0, std::optional(Verdict::pass)));
  EXPECT_EQ(at(less, 3.0), std::pair(50.0, std::optional(Verdict::warn)));
  EXPECT_EQ(at(less, 4.0), std::pair(0.0, std::optional(Verdict::warn)));
  EXPECT_EQ(at(less, 4.1), std::pair(0.0, std::optional(Verdict::fail)));
  const nlohmann::json more = {{"metric", "x"},
                               {"band", {{"better", "more"}, {"pass", 90.0}, {"warn", 80.0}}}};
  EXPECT_EQ(at(more, 95.0), std::pair(100.0, std::optional(Verdict::pass)));
  EXPECT_EQ(at(more, 87.5), std::pair(75.0, std::optional(Verdict::warn)));
  EXPECT_EQ(at(more, 79.0), std::pair(0.0, std::optional(Verdict::fail)));
  const nlohmann::json between = {{"metric", "x"},
                                  {"band", {{"better", "between"}, {"low", 35.0}, {"pass", 70.0}}}};
  EXPECT_EQ(at(between, 35.0), std::pair(100.0, std::optional(Verdict::pass)));
  EXPECT_EQ(at(between, 71.0), std::pair(50.0, std::optional(Verdict::warn)));
  const nlohmann::json sharp = {{"metric", "x"},
                                {"band", {{"better", "less"}, {"pass", 104.0}, {"warn", 104.0}}}};
  EXPECT_EQ(at(sharp, 104.0), std::pair(100.0, std::optional(Verdict::pass)));
  EXPECT_EQ(at(sharp, 104.5), std::pair(0.0, std::optional(Verdict::fail)));
}

TEST(RubricScore, ACurveIsStraightBetweenItsPointsAndLevelBeyond) {
  const Rubric r = rubric(nlohmann::json::array({{{"metric", "thrust_n"},
                                                  {"curve",
                                                   {{{"at", 15}, {"points", 0}},
                                                    {{"at", 35}, {"points", 100}},
                                                    {{"at", 70}, {"points", 100}},
                                                    {{"at", 104}, {"points", 20}}}}}}));
  const std::pair<double, double> expected[] = {{-1.0, 0.0},   {15.0, 0.0},  {25.0, 50.0},  {35.0, 100.0},
                                                {50.0, 100.0}, {87.0, 60.0}, {104.0, 20.0}, {500.0, 20.0}};
  for (const auto& [value, points] : expected)
    EXPECT_DOUBLE_EQ(points_of(r.criteria[0], value), points) << value;
}

TEST(RubricScore, ABandOfTheRubricStandsBeforeTheCatalogues) {
  const nlohmann::json metrics = {{"version_error_deg", 4.0}};
  const Score by_catalogue =
      apply_rubric(rubric(nlohmann::json::array({{{"metric", "version_error_deg"}}})), metrics);
  EXPECT_EQ(by_catalogue.criteria[0].verdict, Verdict::pass);
  const nlohmann::json strict = {{"metric", "version_error_deg"},
                                 {"band", {{"better", "less"}, {"pass", 1}, {"warn", 3}}}};
  EXPECT_EQ(apply_rubric(rubric(nlohmann::json::array({strict})), metrics).criteria[0].verdict,
            Verdict::fail);
}

TEST(RubricScore, ACriticalCriterionDecidesWhateverThePoints) {
  const Rubric r = rubric({limited("breach_mm", true, 0.0), limited("error_mm", false, 100.0)}, 70.0);
  EXPECT_EQ(apply_rubric(r, {{"breach_mm", 0.0}, {"error_mm", 0.0}}).outcome, Outcome::pass);
  const Score breached = apply_rubric(r, {{"breach_mm", 4.5}, {"error_mm", 0.0}});
  EXPECT_DOUBLE_EQ(*breached.points, 100.0);
  EXPECT_EQ(breached.outcome, Outcome::fail);
  EXPECT_NE(breached.reasons.front().find("breach_mm failed; it is a critical criterion"), std::string::npos);
  EXPECT_EQ(apply_rubric(r, {{"breach_mm", 3.0}, {"error_mm", 0.0}}).outcome, Outcome::pass) << "warned only";
  EXPECT_EQ(apply_rubric(r, {{"breach_mm", nullptr}, {"error_mm", 0.0}}).outcome, Outcome::undecided);
  EXPECT_EQ(apply_rubric(r, {{"breach_mm", nullptr}, {"error_mm", 9.0}}).outcome, Outcome::fail)
      << "too few points, whatever the breach is";
  EXPECT_EQ(
      apply_rubric(rubric(nlohmann::json::array({limited("breach_mm", true)})), {{"breach_mm", 0.0}}).outcome,
      Outcome::pass)
      << "without a mark the critical criteria alone decide";
}

TEST(RubricScore, PointsDecideByTheMark) {
  const Rubric r = rubric({limited("a_mm"), limited("b_mm")}, 75.0);
  EXPECT_EQ(apply_rubric(r, {{"a_mm", 1.0}, {"b_mm", 3.0}}).outcome, Outcome::pass) << "75 points are enough";
  const Score short_of = apply_rubric(r, {{"a_mm", 1.0}, {"b_mm", 3.001}});
  EXPECT_EQ(short_of.outcome, Outcome::fail);
  EXPECT_NE(short_of.reasons.front().find("74.9 of 100 points"), std::string::npos)
      << "never rounded up to the mark";
}

TEST(RubricScore, AMarkWithHundredthsIsReadAsPointsAre) {
  const Rubric r = rubric({limited("a_mm"), limited("b_mm")}, 72.3478);
  EXPECT_EQ(apply_rubric(r, {{"a_mm", 1.0}, {"b_mm", 3.1044}}).outcome, Outcome::pass) << "72.39 points";
}

TEST(RubricScore, TooLittleSaidIsNotDecided) {
  const Rubric r = rubric({limited("a_mm", false, 2.0), limited("b_mm", false, 3.0)}, 70.0);
  const Score one = apply_rubric(r, {{"a_mm", 0.0}, {"b_mm", nullptr}});
  EXPECT_FALSE(one.points) << "40 % of the weights is less than half";
  EXPECT_EQ(one.outcome, Outcome::undecided);
  EXPECT_EQ(apply_rubric(r, {{"a_mm", nullptr}, {"b_mm", 0.0}}).outcome, Outcome::pass);
  const Score none = apply_rubric(r, {{"a_mm", nullptr}, {"b_mm", nullptr}});
  EXPECT_FALSE(none.points);
  EXPECT_EQ(none.outcome, Outcome::undecided);
  EXPECT_TRUE(score_json(r, none).at("points").is_null());
}

TEST(RubricScore, OldMetricsDoNotSayWhatIsMeasuredSince) {
  const nlohmann::json since = nlohmann::json::array({{{"metric", "version_error_deg"}}});
  const Score score = apply_rubric(rubric(since), {{"duration_s", 3.0}});
  EXPECT_FALSE(score.criteria[0].value);
  EXPECT_NE(score.criteria[0].missing_reason.find("score the session anew"), std::string::npos);
}

}  // namespace
}  // namespace ream::score
