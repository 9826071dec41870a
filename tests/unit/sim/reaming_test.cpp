#include <gtest/gtest.h>

#include <cmath>

#include "core/units.hpp"
#include "force/coefficients.hpp"
#include "force/feed_model.hpp"
#include "score/metrics.hpp"
#include "support/small_run.hpp"

namespace ream::test {
namespace {

constexpr double surface_mm = 9.0;

SmallRun press_on_slab(double force_n, double density, double duration_s, double force_scale = 1.0,
                       const std::string& tool = "sphere 8,5") {
  voxel::BoneModel bone = slab({96, 96, 96}, 0.15, surface_mm, density);
  const case_::Plan plan = slab_plan(bone, surface_mm);
  return SmallRun(std::move(bone), plan, tool, steady_push(force_n, duration_s, force_scale));
}

/// Mean feed over the last part of a run.
double settled_feed(const std::vector<record::TickReport>& reports, size_t ticks) {
  const auto& a = reports[reports.size() - ticks];
  const auto& b = reports.back();
  return (b.world_from_tool.translation_mm - a.world_from_tool.translation_mm).norm() /
         (static_cast<double>(ticks - 1) * 1e-3);
}

TEST(Reaming, FeedsAtTheEmpiricalRateInCorticalBone) {
  SmallRun run = press_on_slab(52.0, 1.5, 4.0);
  const auto reports = run.run();
  ASSERT_EQ(reports.size(), 4000u);
  EXPECT_NEAR(settled_feed(reports, 2000), -0.05 * 1.5 + 0.11, 0.02 * 0.035);
  EXPECT_NEAR(reports.back().thrust_n, 52.0, 1.0);
}

TEST(Reaming, FeedsAtTheEmpiricalRateInCancellousBoneAtAnyForceScale) {
  for (const double scale : {1.0, 26.0}) {
    SmallRun run = press_on_slab(40.0, 0.6, 3.0, scale);
    const auto reports = run.run();
    const double law = (40.0 / 52.0) * (-0.34 * 0.6 + 0.42);
    EXPECT_NEAR(settled_feed(reports, 1500), law, 0.02 * law) << "force scale " << scale;
    EXPECT_NEAR(reports.back().hand_force_n.norm() * scale, 40.0, 1.5) << "force scale " << scale;
  }
}

TEST(Reaming, RemovedVolumeIsTheSweptCap) {
  SmallRun run = press_on_slab(80.0, 0.5, 4.0);
  const auto reports = run.run();
  score::MetricsAccumulator metrics(run.bone.grid.voxel_volume_mm3(), run.model.world_from_plan.inverse());
  for (const auto& r : reports) metrics.add(r);
  const double apex_mm =
      (run.model.world_from_plan.inverse().point(reports.back().world_from_tool.translation_mm)).z();
  ASSERT_GT(apex_mm, 0.5);
  const double cap_mm3 = pi * apex_mm * apex_mm * (8.0 - apex_mm / 3.0);
  EXPECT_NEAR(metrics.removed_volume_mm3(), cap_mm3, 0.02 * cap_mm3);
}

TEST(Reaming, StandingSpindleIsARigidWall) {
  voxel::BoneModel bone = slab({96, 96, 96}, 0.15, surface_mm, 0.5);
  const uint64_t before = bone.coverage_hash();
  const case_::Plan plan = slab_plan(bone, surface_mm);
  device::Script script = steady_push(52.0, 2.0);
  script.buttons = {{0.0, false, false}};
  SmallRun run(std::move(bone), plan, "sphere 8,5", script);
  const auto reports = run.run();
  EXPECT_EQ(run.bone.coverage_hash(), before);
  // Sideways it may creep: a round tip that touches in one point of its shell sticks by friction alone.
  const Vec3 way_mm =
      reports.back().world_from_tool.translation_mm - reports[1000].world_from_tool.translation_mm;
  EXPECT_LT(std::abs(way_mm.dot(plan.axis_direction)), 1e-3);
  EXPECT_LT(way_mm.norm(), 0.01);
  EXPECT_NEAR(reports.back().thrust_n, 52.0, 1.0);
}

TEST(Reaming, PausePutsNoForceOnTheHandAndRemovesNothing) {
  voxel::BoneModel bone = slab({96, 96, 96}, 0.15, surface_mm, 0.5);
  const case_::Plan plan = slab_plan(bone, surface_mm);
  device::Script script = steady_push(52.0, 1.0);
  script.buttons = {{0.5, true, true}};
  SmallRun run(std::move(bone), plan, "sphere 8,5", script);
  const auto reports = run.run();
  EXPECT_GT(reports[450].thrust_n, 10.0);
  for (size_t i = 500; i < reports.size(); ++i) {
    EXPECT_EQ(reports[i].hand_force_n.norm(), 0.0);
    EXPECT_EQ(reports[i].changed_bricks, 0u);
  }
}

TEST(Reaming, WithdrawingNeverPulls) {
  voxel::BoneModel bone = slab({96, 96, 96}, 0.15, surface_mm, 0.5);
  const case_::Plan plan = slab_plan(bone, surface_mm);
  device::Script script = steady_push(52.0, 2.0);
  script.hand.force_profile = {{0.0, 52.0}, {1.0, 52.0}, {1.1, -20.0}};
  SmallRun run(std::move(bone), plan, "sphere 8,5", script);
  const auto reports = run.run();
  const Vec3 axis = run.model.world_from_plan.rotation.col(2);
  for (const auto& r : reports) EXPECT_LE(r.hand_force_n.dot(axis), 1e-6) << "tick " << r.tick;
  EXPECT_FALSE(reports.back().engaged);
  EXPECT_LT((reports.back().world_from_tool.translation_mm - reports.back().world_from_handle.translation_mm)
                .norm(),
            1e-5);
}

TEST(Reaming, PeckingReamsOn) {
  // Lifting off and pressing again must not cost bone: what has been cut does not hold the tool up.
  const auto removed_mm3 = [](bool pecks) {
    voxel::BoneModel bone = slab({96, 96, 96}, 0.15, surface_mm, 0.5);
    const case_::Plan plan = slab_plan(bone, surface_mm);
    device::Script script = steady_push(52.0, pecks ? 5.0 : 4.0);
    if (pecks)
      script.hand.force_profile = {{0.0, 52.0}, {2.0, 52.0}, {2.1, -10.0}, {2.9, -10.0}, {3.0, 52.0}};
    SmallRun run(std::move(bone), plan, "sphere 8,5", script);
    int64_t levels = 0;
    for (const auto& r : run.run())
      for (const int64_t removed : r.coverage_removed) levels += removed;
    return static_cast<double>(levels) / 255.0 * run.bone.grid.voxel_volume_mm3();
  };
  const double steady = removed_mm3(false);
  EXPECT_NEAR(removed_mm3(true), steady, 0.12 * steady);
}

TEST(Reaming, SameInputsGiveTheSameBits) {
  SmallRun a = press_on_slab(60.0, 0.6, 1.0), b = press_on_slab(60.0, 0.6, 1.0);
  const auto ra = a.run(), rb = b.run();
  ASSERT_EQ(ra.size(), rb.size());
  EXPECT_EQ(ra.back().session_hash, rb.back().session_hash);
  EXPECT_EQ(a.bone.coverage_hash(), b.bone.coverage_hash());
  SmallRun c = press_on_slab(60.5, 0.6, 1.0);
  EXPECT_NE(c.run().back().session_hash, ra.back().session_hash);
}

TEST(Reaming, AHandThatSlamsDoesNotTunnelThroughAThinWall) {
  // One voxel of bone in air, met at 1 m/s by a standing reamer.
  voxel::BoneModel bone = slab({96, 96, 96}, 0.15, surface_mm, 1.5);
  for (int w = 0; w < 96; ++w)
    for (int v = 0; v < 96; ++v)
      for (int u = 0; u < 96; ++u) bone.coverage[bone.grid.index(u, v, w)] = w == 40 ? 255 : 0;
  case_::Plan plan = slab_plan(bone, 41 * 0.15);
  device::Script script;
  script.kind = device::ScriptKind::poses;
  script.duration_s = 0.05;
  script.stiffness_n_mm = 10.0;
  script.buttons = {{0.0, false, false}};
  script.poses = {{0.0, Vec3(0, 0, -10), Vec3::Zero()}, {0.02, Vec3(0, 0, 10), Vec3::Zero()}};
  SmallRun run(std::move(bone), plan, "sphere 8,5", script);
  const auto reports = run.run();
  for (const auto& r : reports) {
    const double apex_mm = run.model.world_from_plan.inverse().point(r.world_from_tool.translation_mm).z();
    EXPECT_LT(apex_mm, 0.15) << "tick " << r.tick;
  }
  EXPECT_TRUE(reports.back().engaged);
}

}  // namespace
}  // namespace ream::test
