#include "report/session_charts.hpp"

#include <gtest/gtest.h>

#include "score/handling.hpp"
#include "score/metric_catalogue.hpp"

namespace ream::report {
namespace {

TraceSummary trace_of(uint32_t ticks, double thrust_n) {
  TraceSummary trace(ticks, Pose{});
  for (uint32_t i = 0; i < ticks; ++i) {
    record::TickReport r;
    r.engaged = i > ticks / 4 && i <= ticks / 2;
    r.thrust_n = thrust_n;
    trace.add(r);
  }
  return trace;
}

TEST(SessionCharts, ThrustStandsBeforeItsRangeWithTheTimesOfContact) {
  const auto charts = session_charts(trace_of(40'000, 60.0), 2.0, {{10.0, "look", "me"}});
  ASSERT_EQ(charts.size(), 3u);
  const score::Band& mean = score::find_metric("axial_thrust_mean_n")->band;
  EXPECT_EQ(charts[0].ranges.at(0).low, mean.low);
  EXPECT_EQ(charts[0].ranges.at(0).high, mean.pass);
  EXPECT_EQ(charts[0].levels.at(0).y, score::excess_from_n);
  EXPECT_EQ(charts[0].levels.at(1).y, score::find_metric("axial_thrust_peak_n")->band.pass);
  EXPECT_EQ(charts[0].x_name, "time, s");
  ASSERT_EQ(charts[0].stretches.size(), 1u);
  EXPECT_NEAR(charts[0].stretches[0].from, 10.0, 0.1);
  EXPECT_NEAR(charts[0].stretches[0].to, 20.0, 0.1);
  EXPECT_EQ(charts[2].levels.at(0).y, 2.0);
  EXPECT_EQ(charts[2].curves[0].parts.size(), 1u);
  for (const Chart& chart : charts) {
    EXPECT_EQ(chart.moments.at(0).words, "1");
    EXPECT_NEAR(chart.moments.at(0).x, 10.0, 1e-9);
    EXPECT_GT(chart.y_max, chart.y_min);
    EXPECT_FALSE(chart.alt_text.empty());
  }
}

TEST(SessionCharts, LongSessionsAreToldInMinutes) {
  const auto charts = session_charts(trace_of(600'000, 60.0), 2.0, {{300.0, "half", ""}});
  EXPECT_EQ(charts[0].x_name, "time, min");
  EXPECT_NEAR(charts[0].x_max, 10.0, 1e-9);
  EXPECT_NEAR(charts[0].moments[0].x, 5.0, 1e-9);
  EXPECT_NEAR(charts[0].stretches.at(0).to, 5.0, 0.05);
}

TEST(SessionCharts, ASessionThatNeverTouchedBoneHasEmptyCurves) {
  TraceSummary trace(2, Pose{});
  for (int i = 0; i < 2; ++i) trace.add({});
  const auto charts = session_charts(trace, 0.0, {});
  EXPECT_TRUE(charts[0].stretches.empty());
  EXPECT_TRUE(charts[2].curves[0].parts.empty());
  EXPECT_TRUE(charts[2].levels.empty());
  for (const Chart& chart : charts) EXPECT_GT(chart.y_max, chart.y_min);
}

TEST(LearningCharts, ShowEachSessionAndBeginANewSumAfterADecision) {
  std::vector<score::LearningPoint> sessions(10);
  for (auto& session : sessions) {
    session.points = 80.0;
    session.outcome = score::Outcome::pass;
  }
  const auto charts = learning_charts(score::learning_curve({}, sessions), 70.0);
  ASSERT_EQ(charts.size(), 2u);
  EXPECT_EQ(charts[0].levels.at(0).y, 70.0);
  EXPECT_EQ(charts[0].curves.at(0).parts.at(0).size(), 10u);
  ASSERT_EQ(charts[1].curves.at(0).parts.size(), 2u) << "eight passes decide";
  EXPECT_EQ(charts[1].curves[0].parts[0].size(), 8u);
  EXPECT_LT(charts[1].y_min, charts[1].curves[0].parts[0].back().low);
  EXPECT_TRUE(learning_charts(score::learning_curve({}, {sessions[0]}), 70.0).empty());
}

}  // namespace
}  // namespace ream::report
