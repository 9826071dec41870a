#include "sim/press.hpp"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include "support/small_run.hpp"

namespace ream::test {
namespace {

constexpr double spacing_mm = 0.15, press_surface_mm = 9.0;

/// A column of bone, 0.9 mm wide, under the point of the plan frame given by `aside_mm`; nothing else.
voxel::BoneModel column(const Vec3& aside_mm) {
  voxel::BoneModel bone = slab({96, 96, 96}, spacing_mm, press_surface_mm, 1.5);
  const Pose plan_from_grid = sim::world_from_plan(slab_plan(bone, press_surface_mm)).inverse();
  for (int w = 0; w < 96; ++w)
    for (int v = 0; v < 96; ++v)
      for (int u = 0; u < 96; ++u) {
        const Vec3 p = plan_from_grid.point(spacing_mm * Vec3(u + 0.5, v + 0.5, w + 0.5));
        const bool inside = std::abs(p.x() - aside_mm.x()) < 0.45 && std::abs(p.y() - aside_mm.y()) < 0.45;
        if (!inside) bone.coverage[bone.grid.index(u, v, w)] = 0;
      }
  return bone;
}

/// Presses a standing reamer straight down by a fixed way and holds.
device::Script press_and_hold(double depth_mm) {
  device::Script script;
  script.kind = device::ScriptKind::poses;
  script.duration_s = 3.0;
  script.stiffness_n_mm = 5.0;
  script.buttons = {{0.0, false, false}};
  script.poses = {{0.0, Vec3(0, 0, -1), Vec3::Zero()}, {1.0, Vec3(0, 0, depth_mm), Vec3::Zero()}};
  return script;
}

/// Bone beside the axis presses at one known point: what the hand gets about the tool's origin is r x F.
TEST(Press, OffCentreContactTurnsTheToolByItsArm) {
  for (const Vec3& aside_mm : {Vec3(3, 0, 0), Vec3(0, 3, 0), Vec3(-2, -2, 0)}) {
    voxel::BoneModel bone = column(aside_mm);
    const case_::Plan plan = slab_plan(bone, press_surface_mm);
    SmallRun run(std::move(bone), plan, "sphere 8,5", press_and_hold(1.5));
    const auto last = run.run().back();
    ASSERT_TRUE(last.engaged);
    const Mat3 tool_from_world = last.world_from_tool.rotation.transpose();
    const Vec3 force_n = tool_from_world * last.hand_force_n;
    const Vec3 torque_n_mm = tool_from_world * last.hand_torque_n_mm;
    // The cap rises outwards: it meets the column's inner edge or corner.
    const Vec3 inner_mm = aside_mm - 0.45 * aside_mm.array().sign().matrix();
    const Vec3 top_mm = (last.world_from_tool.inverse() * run.model.world_from_plan).point(inner_mm);
    EXPECT_LT(force_n.z(), -2.0);
    const Vec3 expected_n_mm = top_mm.cross(force_n);
    EXPECT_GT(expected_n_mm.norm(), 3.0);
    // Edge and pressing point are known to a voxel and a cell of the tool's points.
    EXPECT_LT((torque_n_mm - expected_n_mm).norm(), (spacing_mm + 0.25) * force_n.norm())
        << torque_n_mm.transpose();
    // Bone at +x that pushes back lifts that side: about +y; bone at +y about -x.
    EXPECT_GT(torque_n_mm.y() * aside_mm.x() - torque_n_mm.x() * aside_mm.y(), 0.0);
  }
}

/// Reams a bowl, stands still in it, then is pulled aside or tilted.
device::Script seat_then(const Vec3& aside_mm, const Vec3& tilt_rad) {
  device::Script script;
  script.kind = device::ScriptKind::poses;
  script.duration_s = 7.5;
  script.stiffness_n_mm = 50.0;
  script.poses = {{0.0, Vec3(0, 0, -0.5), Vec3::Zero()},
                  {3.0, Vec3(0, 0, 1.6), Vec3::Zero()},
                  {6.0, Vec3(0, 0, 1.6), Vec3::Zero()},
                  {7.0, Vec3(0, 0, 1.6) + aside_mm, tilt_rad}};
  script.buttons = {{0.0, true, false}, {6.0, false, false}};
  return script;
}

/// How the seated tool gave way, plan frame, and the wrench on the hand.
struct GaveWay {
  Vec3 moved_mm, turned_rad;
  Vec3 force_n, torque_n_mm;
};

GaveWay seated(const Vec3& aside_mm, const Vec3& tilt_rad) {
  voxel::BoneModel bone = slab({96, 96, 96}, spacing_mm, press_surface_mm, 0.5);
  const case_::Plan plan = slab_plan(bone, press_surface_mm);
  SmallRun run(std::move(bone), plan, "ellipse 6,2", seat_then(aside_mm, tilt_rad));
  const auto reports = run.run();
  const Pose plan_from_world = run.model.world_from_plan.inverse();
  const Pose before = plan_from_world * reports[6000].world_from_tool;
  const Pose after = plan_from_world * reports.back().world_from_tool;
  EXPECT_GT(before.translation_mm.z(), 0.6);
  return {after.translation_mm - before.translation_mm,
          small_vector_from_rotation(before.rotation.transpose() * after.rotation),
          plan_from_world.rotation * reports.back().hand_force_n,
          plan_from_world.rotation * reports.back().hand_torque_n_mm};
}

TEST(Press, ASeatedCapResistsSideways) {
  const GaveWay way = seated(Vec3(0.5, 0, 0), Vec3::Zero());
  EXPECT_LT(way.moved_mm.norm(), 0.1 * 0.5);
  EXPECT_NEAR(way.force_n.x(), -50.0 * 0.5, 0.1 * 25.0);
}

TEST(Press, ASeatedCapResistsTilting) {
  const GaveWay way = seated(Vec3::Zero(), Vec3(0, 0.02, 0));
  // Rolling in its bowl about the centre of the apex's curvature, 18 mm up, would take it 0.015 rad along: a
  // quarter of that or more is held.
  EXPECT_LT(way.turned_rad.norm(), 0.75 * 0.015);
  EXPECT_LT(way.torque_n_mm.y(), -50000.0 * (0.02 - 0.75 * 0.015));
}

TEST(Press, TheHandHoldsTheDriveAgainstTheSpindle) {
  const auto torque_at_52_n = [](bool spindle_on) {
    voxel::BoneModel bone = slab({96, 96, 96}, spacing_mm, press_surface_mm, 1.5);
    const case_::Plan plan = slab_plan(bone, press_surface_mm);
    device::Script script = steady_push(52.0, 1.5);
    script.buttons = {{0.0, spindle_on, false}};
    SmallRun run(std::move(bone), plan, "ellipse 6,4", script);
    const auto last = run.run().back();
    force::EngagedBone hard;
    hard.share = {0.0, 1.0, 0.0};
    hard.density_g_cc = {0.0, 1.5, 0.0};
    const double arm_mm = run.model.feed->load(hard, last.thrust_n).torque_arm_mm;
    // The drive gives what held it back in the tick before.
    EXPECT_NEAR(last.spindle_torque_n_mm, spindle_on ? arm_mm * last.thrust_n : 0.0, 0.01);
    return last.hand_torque_n_mm.dot(last.world_from_tool.rotation.col(2));
  };
  // The spindle turns clockwise seen from behind, which is about +z; the housing is turned the other way.
  EXPECT_LT(torque_at_52_n(true), -52.0);
  EXPECT_NEAR(torque_at_52_n(false), 0.0, 1.0);
}

TEST(Press, ABoneThatStandsStillHoldsAReamerThatStandsStill) {
  // Pressed on a flat slab with 52 N, drawn aside by 5 N: below friction's 10.4 N it stays.
  voxel::BoneModel bone = slab({96, 96, 96}, spacing_mm, press_surface_mm, 1.5);
  const case_::Plan plan = slab_plan(bone, press_surface_mm);
  device::Script script;
  script.kind = device::ScriptKind::poses;
  script.duration_s = 2.0;
  script.stiffness_n_mm = 50.0;
  script.buttons = {{0.0, false, false}};
  script.poses = {{0.0, Vec3(0, 0, -0.5), Vec3::Zero()},
                  {1.0, Vec3(0, 0, 52.0 / 50.0), Vec3::Zero()},
                  {1.2, Vec3(5.0 / 50.0, 0, 52.0 / 50.0), Vec3::Zero()}};
  SmallRun run(std::move(bone), plan, "sphere 8,5", script);
  const auto reports = run.run();
  const Vec3 slid_mm =
      reports.back().world_from_tool.translation_mm - reports[1000].world_from_tool.translation_mm;
  EXPECT_LT(slid_mm.norm(), 0.05);
  EXPECT_GT(reports.back().hand_force_n.norm(), 50.0);
}

TEST(Press, WhatCutsIsNoMoreThanTheDeviceLetsTheHandFeel) {
  // A hand far stronger than its device runs ahead of the tool; the tool does not follow with its spring's
  // force.
  voxel::BoneModel bone = slab({96, 96, 96}, spacing_mm, press_surface_mm, 0.5);
  const case_::Plan plan = slab_plan(bone, press_surface_mm);
  device::Script script = steady_push(20.0, 1.0);
  script.stiffness_n_mm = 0.4;
  sim::Settings settings = SmallRun::settings(script, "cpu");
  sim::fit_to_device(device::device_profile("touch"), 0.4, settings);
  settings.start_up_ramp_s = 0.0;
  SmallRun run(std::move(bone), plan, "sphere 8,5", script, settings);
  const auto reports = run.run();
  for (const auto& r : reports) ASSERT_LE(r.thrust_n, 3.3 + 1e-9) << "tick " << r.tick;
  EXPECT_NEAR(reports.back().thrust_n, 3.3, 0.1);
  EXPECT_TRUE(reports.back().weakened);
}

TEST(Press, NothingIsPressedBeforeTheStartUpRampOpens) {
  voxel::BoneModel bone = slab({96, 96, 96}, spacing_mm, press_surface_mm, 0.5);
  const case_::Plan plan = slab_plan(bone, press_surface_mm);
  device::Script script;
  script.kind = device::ScriptKind::poses;
  script.duration_s = 0.5;
  script.stiffness_n_mm = 1.0;
  script.poses = {{0.0, Vec3(0, 0, 0.0), Vec3::Zero()}, {0.01, Vec3(0, 0, 3.0), Vec3::Zero()}};
  sim::Settings settings = SmallRun::settings(script, "cpu");
  sim::fit_to_device(device::device_profile("omega.6"), 1.0, settings);
  SmallRun run(std::move(bone), plan, "sphere 8,5", script, settings);
  const auto reports = run.run();
  const auto& early = reports[300];
  EXPECT_TRUE(early.weakened);
  EXPECT_LT(early.thrust_n, 2.0) << "of the 3 N that the spring would give";
  EXPECT_NEAR(early.hand_force_n.norm(), early.thrust_n, 0.1);
}

}  // namespace
}  // namespace ream::test
