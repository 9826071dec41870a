#include <gtest/gtest.h>

#include <cmath>

#include "support/small_run.hpp"

namespace ream::test {
namespace {

constexpr double start_surface_mm = 12.0, start_push_n = 52.0;

/// Pressed from the beginning; the trigger is pulled after a second. `aside_mm`: of the bone's edge, so that
/// only the rim of the reamer stands on it.
std::vector<record::TickReport> started_at(double trigger, bool reversed, double density_g_cc,
                                           const char* tool, bool rim_only = false) {
  device::Script script = steady_push(start_push_n, 2.0);
  script.buttons = {
      {0.0, false, false, {}},
      {1.0, true, false, {static_cast<uint8_t>(std::lround(255.0 * trigger)), reversed, false}}};
  sim::Settings settings = SmallRun::settings(script, "cpu", sim::RemovalLaw::profile, force::FeedKind::edge);
  settings.spindle.emplace();
  voxel::BoneModel bone = slab({80, 80, 40}, 0.5, start_surface_mm, density_g_cc);
  const case_::Plan plan = slab_plan(bone, start_surface_mm);
  if (rim_only)
    for (int w = 0; w < 40; ++w)
      for (int v = 0; v < 80; ++v)
        for (int u = 0; u < 56; ++u) bone.coverage[bone.grid.index(u, v, w)] = 0;
  return SmallRun(std::move(bone), plan, tool, script, settings).run();
}

TEST(StartUnderLoad, StallsOrCatchesWithinAFiftiethOfASecond) {
  for (const bool rim_only : {false, true}) {
    const auto reports = started_at(1.0, false, 1.5, "ellipse 16,0.2", rim_only);
    ASSERT_EQ(reports.size(), 2000u);
    double peak_n_mm = 0.0;
    bool stalled = false;
    for (size_t i = 0; i < reports.size(); ++i) {
      if (i < 1000) {
        ASSERT_EQ(reports[i].spindle_torque_n_mm, 0.0) << i;
        ASSERT_FALSE(reports[i].stalled);
      }
      stalled |= i < 1050 && reports[i].stalled;
      peak_n_mm = std::max(peak_n_mm, reports[i].spindle_torque_n_mm);
    }
    EXPECT_TRUE(stalled);
    EXPECT_GT(peak_n_mm, 2000.0) << "the hand is jerked";
    // A rim alone may hold for good, as long as it is pressed.
    if (rim_only) continue;
    EXPECT_GT(reports.back().spindle_speed_rad_s, 12.0) << "it tears loose";
    EXPECT_TRUE(reports.back().cutting);
  }
}

TEST(StartUnderLoad, StandingAndReversedLipsRemoveNothing) {
  for (const double trigger : {0.0, 1.0}) {
    const auto reports = started_at(trigger, true, 0.5, "thesis-appendix-a");
    int64_t removed = 0;
    for (const auto& report : reports) {
      for (const int64_t part : report.coverage_removed) removed += part;
      EXPECT_FALSE(report.cutting);
    }
    EXPECT_EQ(removed, 0);
    EXPECT_LE(reports.back().spindle_speed_rad_s, 0.0);
    EXPECT_LE(reports.back().spindle_torque_n_mm, 0.0);
  }
}

TEST(StartUnderLoad, HalfATriggerIsHalfTheSpeedAndHalfTheFeed) {
  const auto feed_of = [](double trigger) {
    const auto reports = started_at(trigger, false, 0.5, "thesis-appendix-a");
    const auto &a = reports[1700].world_from_tool, &b = reports.back().world_from_tool;
    const double speed = reports.back().spindle_speed_rad_s;
    return std::pair{(b.translation_mm - a.translation_mm).norm() / 0.299, speed};
  };
  const auto [whole_mm_s, whole_rad_s] = feed_of(1.0);
  const auto [half_mm_s, half_rad_s] = feed_of(0.5);
  // The sag is the same in rad/s, as the torque is.
  EXPECT_NEAR(whole_rad_s - half_rad_s, 0.5 * 16.336, 0.1);
  EXPECT_NEAR(half_mm_s / whole_mm_s, half_rad_s / whole_rad_s, 0.15);
}

}  // namespace
}  // namespace ream::test
