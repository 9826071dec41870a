#include <gtest/gtest.h>

#include <cmath>

#include "support/small_run.hpp"

namespace ream::test {
namespace {

constexpr double ledge_mm = 9.0, ledge_voxel_mm = 0.3, stiffness_n_mm = 5.0, mass_kg = 0.8;

/// A ball that is pressed onto a ledge and pushed over its edge, the spindle standing.
SmallRun pushed_over_a_ledge() {
  device::Script script;
  script.kind = device::ScriptKind::poses;
  script.duration_s = 1.0;
  script.stiffness_n_mm = stiffness_n_mm;
  script.poses = {
      {0.0, Vec3(2, 0, -0.5)}, {0.2, Vec3(2, 0, 4)}, {0.7, Vec3(-6, 0, 4)}, {0.8, Vec3(-6, 0, 4)}};
  script.buttons = {{0.0, false}};
  sim::Settings settings = SmallRun::settings(script, "cpu", sim::RemovalLaw::profile, force::FeedKind::edge);
  settings.spindle.emplace().mass_kg = mass_kg;
  voxel::BoneModel bone = slab({96, 96, 64}, ledge_voxel_mm, ledge_mm, 1.5);
  const case_::Plan plan = slab_plan(bone, ledge_mm);
  const Pose plan_from_world = sim::world_from_plan(plan).inverse();
  for (size_t i = 0; i < bone.coverage.size(); ++i) {
    const Vec3 centre = (bone.grid.coordinates(i).cast<double>() + Vec3::Constant(0.5)) * ledge_voxel_mm;
    if (plan_from_world.point(bone.grid.world_from_grid.point(centre)).x() < 0.0) bone.coverage[i] = 0;
  }
  return {std::move(bone), plan, "sphere 4,3", script, settings};
}

TEST(Slip, GainsNoMoreSpeedThanTheSpringGivesTheMass) {
  SmallRun run = pushed_over_a_ledge();
  const auto reports = run.run();
  ASSERT_EQ(reports.size(), 1000u);
  const auto place = [&](size_t i) { return reports[i].world_from_tool.translation_mm; };
  double fastest_mm_s = 0.0, strongest_n = 0.0;
  size_t free_since = 0;
  for (size_t i = 2; i < reports.size(); ++i) {
    if (reports[i].engaged) free_since = i;
    strongest_n = std::max(strongest_n, reports[i].thrust_n);
    // Only what has been on the bone has a spring to be thrown by; before, the tool is where the hand is.
    if (free_since == 0) continue;
    const double before_mm_s = (place(i - 1) - place(i - 2)).norm() / 1e-3;
    const double now_mm_s = (place(i) - place(i - 1)).norm() / 1e-3;
    const double stretch_mm = (reports[i].world_from_handle.translation_mm - place(i - 1)).norm();
    const double gain_mm_s = stiffness_n_mm * stretch_mm / mass_kg;  // N/kg for a millisecond is mm/s
    ASSERT_LE(now_mm_s, before_mm_s + gain_mm_s + 0.01) << i;
    fastest_mm_s = std::max(fastest_mm_s, now_mm_s);
  }
  EXPECT_GT(strongest_n, 15.0) << "it was pressed on";
  EXPECT_GT(fastest_mm_s, 60.0) << "it slipped";
  EXPECT_GT(reports.size() - free_since, 100u);
  EXPECT_LT((reports.back().world_from_handle.translation_mm - place(999)).norm(), 1e-6)
      << "the tool is in the hand again";
  int64_t removed = 0;
  for (const auto& report : reports)
    for (const int64_t part : report.coverage_removed) removed += part;
  EXPECT_EQ(removed, 0);
}

TEST(Slip, TheHandFeelsTheSpringUntilTheToolHasCome) {
  SmallRun run = pushed_over_a_ledge();
  const auto reports = run.run();
  int slipping = 0;
  for (size_t i = 1; i < reports.size(); ++i) {
    if (reports[i].engaged || reports[i].hand_force_n.isZero(0.0)) continue;
    const Vec3 stretch_mm =
        reports[i].world_from_handle.translation_mm - reports[i].world_from_tool.translation_mm;
    EXPECT_LT((reports[i].hand_force_n + stiffness_n_mm * stretch_mm).norm(),
              0.01 + 0.05 * stretch_mm.norm());
    ++slipping;
  }
  EXPECT_GT(slipping, 5);
}

/// Where a pause left the tool in the bone, force rises slowly again; the tool can leave at once.
TEST(Slip, AToolThatAPauseLeftInTheBoneCanBeDrawnOut) {
  device::Script script;
  script.kind = device::ScriptKind::poses;
  script.duration_s = 1.5;
  script.stiffness_n_mm = stiffness_n_mm;
  script.poses = {{0.0, Vec3(0, 0, -0.5)}, {0.2, Vec3(0, 0, 4)}, {1.0, Vec3(0, 0, 4)}, {1.1, Vec3(0, 0, -6)}};
  script.buttons = {{0.0, true, false}, {0.8, true, true}, {0.9, true, false}};
  sim::Settings settings = SmallRun::settings(script, "cpu", sim::RemovalLaw::profile, force::FeedKind::edge);
  settings.spindle.emplace();
  settings.start_up_ramp_s = 2.0;
  voxel::BoneModel bone = slab({64, 64, 64}, ledge_voxel_mm, ledge_mm, 0.6);
  const case_::Plan plan = slab_plan(bone, ledge_mm);
  SmallRun run(std::move(bone), plan, "sphere 4,3", script, settings);
  const auto reports = run.run();
  ASSERT_EQ(reports.size(), 1500u);
  EXPECT_TRUE(reports[750].engaged);
  for (size_t i = 1150; i < reports.size(); ++i) ASSERT_FALSE(reports[i].engaged) << i;
  EXPECT_LT(
      (reports[1300].world_from_handle.translation_mm - reports[1300].world_from_tool.translation_mm).norm(),
      1e-6);
}

}  // namespace
}  // namespace ream::test
