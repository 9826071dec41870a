#include "report/advice.hpp"

#include <gtest/gtest.h>

#include "score/metric_catalogue.hpp"
#include "score/rubric_score.hpp"

namespace ream::report {
namespace {

using nlohmann::json;

std::vector<Advice> advised(const json& metrics) {
  const score::Rubric& rubric = score::standard_rubric();
  return advice_of(score::score_json(rubric, score::apply_rubric(rubric, metrics)), metrics);
}

/// As planned in everything.
json perfect() {
  json metrics = {{"missing", json::object()}};
  for (const score::Metric& metric : score::metric_catalogue()) metrics[std::string(metric.key)] = 0.0;
  metrics["plan_overlap_percent"] = metrics["seating_percent"] = 100.0;
  metrics["axial_thrust_mean_n"] = 52.0;
  return metrics;
}

TEST(Advice, HasNothingToSayOfWhatIsAsPlanned) { EXPECT_TRUE(advised(perfect()).empty()); }

TEST(Advice, PutsFirstWhatFailsTheSessionThenWhatCostsMost) {
  json metrics = perfect();
  metrics["version_error_deg"] = 5.0;
  metrics["congruity_mm"] = 0.5;
  metrics["vault_breach_mm"] = 0.3;
  const std::vector<Advice> advice = advised(metrics);
  ASSERT_EQ(advice.size(), 3u);
  EXPECT_EQ(advice[0].metric, "vault_breach_mm");
  EXPECT_TRUE(advice[0].decides);
  EXPECT_EQ(advice[0].words,
            "Keep pegs or keel inside the bone: along this axis they come 0.30\u00a0mm through the cortex.");
  EXPECT_EQ(advice[1].metric, "version_error_deg");
  EXPECT_EQ(advice[2].metric, "congruity_mm");
  EXPECT_GT(advice[1].lost_points, advice[2].lost_points);
}

TEST(Advice, KnowsTooMuchFromTooLittle) {
  json deep = perfect(), shallow = perfect();
  deep["depth_error_mm"] = shallow["depth_error_mm"] = 0.8;
  deep["depth_planned_mm"] = shallow["depth_planned_mm"] = 1.0;
  deep["reaming_depth_mm"] = 1.8;
  shallow["reaming_depth_mm"] = 0.2;
  EXPECT_TRUE(advised(deep).at(0).words.starts_with("Stop earlier")) << advised(deep).at(0).words;
  EXPECT_TRUE(advised(shallow).at(0).words.starts_with("Go on")) << advised(shallow).at(0).words;
  deep.erase("depth_planned_mm");
  EXPECT_TRUE(advised(deep).at(0).words.starts_with("Stop at the planned depth"))
      << advised(deep).at(0).words;
  json light = perfect(), heavy = perfect();
  light["axial_thrust_mean_n"] = 12.0;
  heavy["axial_thrust_mean_n"] = 95.0;
  EXPECT_TRUE(advised(light).at(0).words.starts_with("Press harder"));
  EXPECT_TRUE(advised(heavy).at(0).words.starts_with("Press less"));
}

TEST(Advice, WhatLosesPointsAddsUpToWhatIsMissing) {
  json metrics = perfect();
  metrics["version_error_deg"] = 5.0;
  metrics["entry_error_mm"] = 2.0;
  double lost = 0.0;
  for (const Advice& each : advised(metrics)) lost += each.lost_points;
  EXPECT_NEAR(100.0 - lost, *score::apply_rubric(score::standard_rubric(), metrics).points, 0.1);
}

TEST(Advice, HasWordsForEveryLineOfEveryStandardRubric) {
  for (const score::Rubric& rubric : score::standard_rubrics())
    for (const score::Criterion& criterion : rubric.criteria) {
      json metrics = perfect();
      metrics["plate_preserved_percent"] = 100.0;
      const bool more_is_better = criterion.judged_by().better == score::Better::more;
      metrics[criterion.metric] = more_is_better ? 10.0 : 1000.0;
      const auto advice = advice_of(score::score_json(rubric, score::apply_rubric(rubric, metrics)), metrics);
      ASSERT_EQ(advice.size(), 1u) << rubric.version << ": " << criterion.metric;
      EXPECT_NE(advice[0].words.find(": "), std::string::npos)
          << "says what to do, and why: " << advice[0].words;
      EXPECT_EQ(advice[0].words.find("{}"), std::string::npos) << advice[0].words;
    }
}

TEST(Advice, NamesMetricsOfOtherRubrics) {
  const score::Rubric rubric =
      score::rubric_from_json({{"name", "fast"},
                               {"version", 1},
                               {"criteria", {{{"metric", "duration_s"}, {"none", 600}, {"full", 60}}}}},
                              "fast");
  const json metrics = {{"duration_s", 600.0}};
  const auto advice = advice_of(score::score_json(rubric, score::apply_rubric(rubric, metrics)), metrics);
  ASSERT_EQ(advice.size(), 1u);
  EXPECT_TRUE(advice[0].words.starts_with("Duration was ")) << advice[0].words;
}

}  // namespace
}  // namespace ream::report
