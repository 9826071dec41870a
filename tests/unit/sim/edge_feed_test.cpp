#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>

#include "force/coefficients.hpp"
#include "force/edge_load.hpp"
#include "support/bone_post.hpp"
#include "support/full_tests.hpp"
#include "support/small_run.hpp"

namespace ream::test {
namespace {

constexpr double pressed_n = 52.0, hard_g_cc = 1.5;
/// Of the thesis: eq. 5.1 at 1.5 g/cc; lips; edge engaged in its experiments as the model takes it.
constexpr double law_mm_s = 0.035, lips = 5.0, reference_edge_mm = 70.5;

/// The second half of two seconds of pressing.
struct Pressing {
  double feed_mm_s = 0.0;
  double energy_j_mm3 = 0.0;  ///< of the spindle, for what was removed
  record::TickReport last;
  Pose plan_from_world;

  Vec3 hand_force_n() const { return plan_from_world.rotation * last.hand_force_n; }
};

Pressing press(voxel::BoneModel bone, const char* tool, double force_n = pressed_n) {
  const case_::Plan plan = slab_plan(bone, post_top_mm);
  device::Script script = steady_push(force_n, 2.0);
  script.stiffness_n_mm = 400.0;
  SmallRun run(std::move(bone), plan, tool, script, "cpu", sim::RemovalLaw::profile, force::FeedKind::edge);
  const auto reports = run.run();
  const auto &a = reports[1000], &b = reports.back();
  const Vec3 way_mm = b.world_from_tool.translation_mm - a.world_from_tool.translation_mm;
  double work_j = 0.0, removed_mm3 = 0.0;
  for (size_t i = 1000; i < reports.size(); ++i) {
    const auto& r = reports[i];
    work_j += 1e-6 * r.spindle_torque_n_mm * r.spindle_speed_rad_s;
    for (const int64_t levels : r.coverage_removed)
      removed_mm3 += static_cast<double>(levels) / 255.0 * std::pow(post_voxel_mm, 3);
  }
  return {way_mm.dot(plan.axis_direction) / (1e-3 * static_cast<double>(b.tick - a.tick)),
          work_j / removed_mm3, b, run.model.world_from_plan.inverse()};
}

/// A tool that is all but flat where it touches.
constexpr const char* flat_tool = "ellipse 30,0.2";

TEST(EdgeFeed, AConcentricPunchFeedsByItsRadius) {
  // Edge of a disc of radius R: integral of lips / (2 pi r) 2 pi r dr.
  for (const double area_mm2 : {30.0, 100.0, 300.0, 600.0}) {
    const double edge_mm = lips * std::sqrt(area_mm2 / pi);
    const Pressing steady = press(round_post(area_mm2, 0.0, hard_g_cc), flat_tool);
    EXPECT_NEAR(steady.feed_mm_s, law_mm_s * reference_edge_mm / edge_mm,
                0.05 * law_mm_s * reference_edge_mm / edge_mm)
        << area_mm2;
    // A hand as soft as this one, 20 N/mm, holds the smallest post within 0.05 mm of the axis.
    const double sideways_n = std::hypot(steady.hand_force_n().x(), steady.hand_force_n().y());
    EXPECT_LT(sideways_n, (area_mm2 < 50.0 ? 0.03 : 0.02) * pressed_n) << area_mm2;
    // Torque: load q along the edge times r: q (lips / 2 pi) A, with q = F / edge.
    const double torque_n_mm = pressed_n / edge_mm * lips / (2.0 * pi) * area_mm2;
    EXPECT_NEAR(steady.last.spindle_torque_n_mm, torque_n_mm, 0.06 * torque_n_mm) << area_mm2;
  }
}

/// With phi 0 the load of a lip over its chip is a constant of the bone, so what a removed volume costs does
/// not depend on where and how much the reamer touches: load per edge, over the chip that a lip takes of it.
TEST(EdgeFeed, ARemovedVolumeCostsTheSameInEveryContact) {
  constexpr double turns_a_second = 2.6;
  const double j_mm3 = 1e-3 * pressed_n / reference_edge_mm * lips * turns_a_second / law_mm_s;
  EXPECT_NEAR(j_mm3, 0.27, 0.01);
  for (const double area_mm2 : {30.0, 100.0, 300.0, 600.0})
    EXPECT_NEAR(press(round_post(area_mm2, 0.0, hard_g_cc), flat_tool).energy_j_mm3, j_mm3, 0.1 * j_mm3)
        << area_mm2;
  EXPECT_NEAR(press(round_post(50.0, 9.0, hard_g_cc), flat_tool).energy_j_mm3, j_mm3, 0.2 * j_mm3)
      << "it walks";
  for (const double force_n : {5.0, 120.0})
    EXPECT_NEAR(press(round_post(100.0, 0.0, hard_g_cc), flat_tool, force_n).energy_j_mm3, j_mm3, 0.1 * j_mm3)
        << force_n;
  for (const double density_g_cc : {0.41, 0.72, 1.0, 1.3, 1.61, 1.9}) {
    const double cost = press(round_post(100.0, 0.0, density_g_cc), flat_tool).energy_j_mm3;
    std::cout << density_g_cc << " g/cc: " << cost << " J/mm3\n";
    EXPECT_GT(cost, 0.03) << density_g_cc;
    EXPECT_LT(cost, 5.0) << density_g_cc;
  }
}

TEST(EdgeFeed, OffTheAxisItFeedsFastAndPullsAcrossTheTurn) {
  constexpr double aside_mm = 9.0, area_mm2 = 50.0;
  const Pressing steady = press(round_post(area_mm2, aside_mm, hard_g_cc), flat_tool);
  const double feed_mm_s = law_mm_s * reference_edge_mm / (lips * area_mm2 / (2.0 * pi * aside_mm));
  EXPECT_NEAR(steady.feed_mm_s, feed_mm_s, 0.12 * feed_mm_s);
  // Lips pass the post from +x towards +y and are held back there: the tool goes the other way, until the
  // hand holds it.
  const Vec3 tool_mm = steady.plan_from_world.point(steady.last.world_from_tool.translation_mm);
  const Vec3 to_post_mm(aside_mm - tool_mm.x(), -tool_mm.y(), 0.0);
  EXPECT_LT(tool_mm.y(), -1.0) << "it walks";
  const Vec3 expected_n =
      Vec3(to_post_mm.y(), -to_post_mm.x(), 0.0) * steady.last.spindle_torque_n_mm / to_post_mm.squaredNorm();
  const Vec3 hand_n = steady.hand_force_n();
  EXPECT_GT(expected_n.norm(), 0.85 * pressed_n);
  EXPECT_NEAR(hand_n.x(), expected_n.x(), 0.1 * expected_n.norm());
  EXPECT_NEAR(hand_n.y(), expected_n.y(), 0.1 * expected_n.norm());
}

TEST(EdgeFeed, TheThesisReamerFullySeatedFeedsAsItMeasured) {
  const std::vector<double> all{0.42, 0.55, 0.70, 1.32, 1.45, 1.60}, ends{0.42, 1.60};
  for (const double density_g_cc : full_tests() ? all : ends) {
    const double law = density_g_cc < 1.0 ? -0.34 * density_g_cc + 0.42 : -0.05 * density_g_cc + 0.11;
    const Pressing steady = press(seated_face(density_g_cc), "thesis-appendix-a");
    EXPECT_NEAR(steady.feed_mm_s, law, 0.02 * law) << density_g_cc;
    EXPECT_GT(steady.last.spindle_torque_n_mm, 240.0) << density_g_cc;
    EXPECT_LT(steady.last.spindle_torque_n_mm, 900.0) << density_g_cc;
  }
}

TEST(EdgeFeed, TheLawFallsWithDensityWithoutAGapAndNeverStops) {
  double before = force::reference_feed_mm_s(0.0);
  for (double density_g_cc = 0.01; density_g_cc < 2.6; density_g_cc += 0.002) {
    const double feed = force::reference_feed_mm_s(density_g_cc);
    EXPECT_LE(feed, before) << density_g_cc;
    EXPECT_GT(feed, 0.98 * before) << "a step at " << density_g_cc;
    before = feed;
  }
  EXPECT_GT(before, 0.005);
  EXPECT_TRUE(force::is_fitted_density(0.6));
  EXPECT_FALSE(force::is_fitted_density(1.0));
}

TEST(EdgeFeed, AThresholdHoldsThinChipsBack) {
  force::FeedSettings settings;
  settings.kind = force::FeedKind::edge;
  settings.cutting.edge_threshold_share = 0.3;
  const auto model = force::make_feed_model(settings, {});
  force::EngagedBone seated;
  seated.share = {0.0, 1.0, 0.0};
  seated.edge_mm = reference_edge_mm;
  seated.resistance_s_mm = 1.0 / law_mm_s;
  const auto feed = [&](double force_n) { return force_n / model->load(seated, force_n).resistance_n_s_mm; };
  EXPECT_NEAR(feed(52.0), law_mm_s, 1e-9);
  EXPECT_LT(feed(15.0), 1e-4) << "below 0.3 of 52 N nothing";
  EXPECT_NEAR(feed(78.0) / law_mm_s, (78.0 / 52.0 - 0.3) / 0.7, 1e-9);
}

}  // namespace
}  // namespace ream::test
