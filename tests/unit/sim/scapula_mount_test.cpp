#include "sim/scapula_mount.hpp"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <cmath>

#include "core/clock.hpp"
#include "score/metrics.hpp"
#include "support/small_run.hpp"

namespace ream::test {
namespace {

constexpr double mount_surface_mm = 9.0;

device::ScapulaMount mount_of(double stiffness_n_mm, double time_constant_s = 0.1) {
  device::ScapulaMount m;
  m.stiffness_n_mm = Vec3::Constant(stiffness_n_mm);
  m.damping_n_s_mm = time_constant_s * m.stiffness_n_mm;
  m.angular_stiffness_n_mm_rad = Vec3::Constant(6000.0 * stiffness_n_mm);
  m.angular_damping_n_mm_s_rad = time_constant_s * m.angular_stiffness_n_mm_rad;
  return m;
}

SmallRun pressed(const std::optional<device::ScapulaMount>& mount, double force_n = 52.0,
                 double duration_s = 3.0, bool spindle = true) {
  voxel::BoneModel bone = slab({96, 96, 96}, 0.15, mount_surface_mm, 0.6);
  const case_::Plan plan = slab_plan(bone, mount_surface_mm);
  device::Script script = steady_push(force_n, duration_s);
  script.mount = mount;
  script.buttons = {{0.0, spindle, false}};
  return SmallRun(std::move(bone), plan, "sphere 8,5", script);
}

/// Depth of the tool's apex below the planned entry, in the bone.
double depth_mm(const SmallRun& run, const record::TickReport& r) {
  return (run.model.world_from_plan.inverse() * r.world_from_bone_rest.inverse() * r.world_from_tool)
      .translation_mm.z();
}

double removed_mm3(const SmallRun& run, const std::vector<record::TickReport>& reports) {
  score::MetricsAccumulator metrics(run.bone.grid.voxel_volume_mm3(), run.model.world_from_plan.inverse());
  for (const auto& r : reports) metrics.add(r);
  return metrics.removed_volume_mm3();
}

double feed_mm_s(const SmallRun& run, const std::vector<record::TickReport>& reports, size_t ticks) {
  return (depth_mm(run, reports.back()) - depth_mm(run, reports[reports.size() - ticks])) /
         (static_cast<double>(ticks - 1) * tick_s);
}

TEST(ScapulaMount, SettlesAtLoadOverStiffnessWithItsTimeConstant) {
  device::ScapulaMount mount = mount_of(10.0, 0.1);
  mount.stiffness_n_mm = {5.0, 10.0, 20.0};
  mount.damping_n_s_mm = 0.1 * mount.stiffness_n_mm;
  const force::Wrench load{Vec3(10, -20, 30), Vec3(600, 0, -300)};
  sim::MountState state;
  for (int i = 0; i < 100; ++i) state = sim::settled_mount(mount, state, load, tick_s);
  const double share = 1.0 - std::exp(-1.0);
  EXPECT_NEAR(state.shift_mm.x(), share * 2.0, 0.01 * 2.0);
  for (int i = 0; i < 1500; ++i) state = sim::settled_mount(mount, state, load, tick_s);
  EXPECT_LT((state.shift_mm - Vec3(2.0, -2.0, 1.5)).norm(), 1e-5);
  EXPECT_LT((state.turn_rad - Vec3(0.01, 0.0, -0.005)).norm(), 1e-7);
  for (int i = 0; i < 3000; ++i) state = sim::settled_mount(mount, state, {}, tick_s);
  EXPECT_LT(state.shift_mm.norm() + state.turn_rad.norm(), 1e-9);
}

TEST(ScapulaMount, TurnsAboutItsPoint) {
  const Vec3 point(10.0, -4.0, 7.0);
  sim::MountState state;
  state.shift_mm = Vec3(1.0, 2.0, 3.0);
  state.turn_rad = Vec3(0.0, 0.0, 2.0 * std::tan(0.5 * 0.3));  // Cayley's vector of 0.3 rad
  const Pose moved = sim::displacement(state, point);
  EXPECT_LT((moved.point(point) - point - state.shift_mm).norm(), 1e-12);
  const Vec3 there = moved.point(point + Vec3(2.0, 0.0, 0.0)) - point - state.shift_mm;
  EXPECT_LT((there - 2.0 * Vec3(std::cos(0.3), std::sin(0.3), 0.0)).norm(), 1e-12);
}

TEST(ScapulaMount, GivesWayUnderASteadyPush) {
  SmallRun run = pressed(mount_of(10.0), 52.0, 3.0, false);
  const auto reports = run.run();
  const auto& last = reports.back();
  EXPECT_NEAR(last.thrust_n, 52.0, 0.5);
  const Vec3 entry = run.model.plan.entry_mm;
  const Vec3 shift = last.world_from_bone_rest.point(entry) - entry;
  EXPECT_NEAR(shift.dot(run.model.plan.axis_direction), 5.2, 0.1);
  EXPECT_LT(shift.cross(run.model.plan.axis_direction).norm(), 0.05);
  // The bone carries the tool, and the tool the bone: contact is kept.
  for (size_t i = 500; i < reports.size(); ++i) EXPECT_TRUE(reports[i].engaged) << "tick " << i;
}

TEST(ScapulaMount, AnOffCentreLoadTurnsTheBone) {
  voxel::BoneModel bone = slab({96, 96, 96}, 0.15, mount_surface_mm, 1.5);
  const case_::Plan plan = slab_plan(bone, mount_surface_mm);
  device::Script script = steady_push(52.0, 2.0);
  script.hand.start_mm = Vec3(3.0, 0.0, -0.6);
  script.buttons = {{0.0, false, false}};
  script.mount = device::chest_wall_mount;
  SmallRun run(std::move(bone), plan, "sphere 8,5", script);
  const auto reports = run.run();
  // 52 N 3 mm beside the entry on 60 N m/rad, and the little that the tool is pushed aside.
  const Mat3 plan_from_world = run.model.world_from_plan.rotation.transpose();
  const Mat3 turned =
      plan_from_world * reports.back().world_from_bone_rest.rotation * plan_from_world.transpose();
  const Vec3 turn = small_vector_from_rotation(turned);
  EXPECT_NEAR(turn.y(), -52.0 * 3.0 / 60.0e3, 0.2 * 52.0 * 3.0 / 60.0e3);
  EXPECT_LT(std::abs(turn.x()), 2e-4);
}

TEST(ScapulaMount, FeedIsRelativeToTheBone) {
  SmallRun rigid = pressed(std::nullopt), soft = pressed(device::chest_wall_mount);
  const auto a = rigid.run(), b = soft.run();
  ASSERT_EQ(a.size(), b.size());
  const double feed = feed_mm_s(rigid, a, 1500);
  EXPECT_NEAR(feed_mm_s(soft, b, 1500), feed, 0.02 * feed);
  EXPECT_NEAR(b.back().feed_rate_mm_s, feed, 0.02 * feed);
  for (size_t i = 1000; i < b.size(); ++i) {
    EXPECT_TRUE(b[i].engaged) << "tick " << i;
    EXPECT_NEAR(b[i].thrust_n, 52.0, 0.02 * 52.0) << "tick " << i;
  }
}

TEST(ScapulaMount, AsMuchBoneIsRemoved) {
  // The bone goes with the push before it is cut: the same bite, a little later.
  SmallRun rigid = pressed(std::nullopt, 52.0, 12.0), soft = pressed(device::chest_wall_mount, 52.0, 12.0);
  const auto a = rigid.run(), b = soft.run();
  const double late_mm = depth_mm(rigid, a.back()) - depth_mm(soft, b.back());
  EXPECT_GE(late_mm, -0.01);
  const double whole = removed_mm3(rigid, a);
  EXPECT_NEAR(removed_mm3(soft, b), whole, 0.02 * whole) << late_mm << " mm behind";
}

TEST(ScapulaMount, AVeryStiffMountIsRigid) {
  SmallRun rigid = pressed(std::nullopt), stiff = pressed(mount_of(1.0e7, 0.0));
  const auto a = rigid.run(), b = stiff.run();
  EXPECT_LT(b.back().world_from_bone_rest.translation_mm.norm(), 0.01);
  EXPECT_NEAR(depth_mm(stiff, b.back()), depth_mm(rigid, a.back()), 1e-3);
  EXPECT_NEAR(removed_mm3(stiff, b), removed_mm3(rigid, a), 1e-3 * removed_mm3(rigid, a));
}

TEST(ScapulaMount, ItSpringsBackWhenTheToolIsGone) {
  voxel::BoneModel bone = slab({96, 96, 96}, 0.15, mount_surface_mm, 0.6);
  const case_::Plan plan = slab_plan(bone, mount_surface_mm);
  device::Script script = steady_push(52.0, 4.0);
  script.hand.force_profile = {{0.0, 52.0}, {1.5, 52.0}, {1.6, -20.0}};
  script.mount = device::chest_wall_mount;
  SmallRun run(std::move(bone), plan, "sphere 8,5", script);
  const auto reports = run.run();
  EXPECT_GT(reports[1400].world_from_bone_rest.translation_mm.norm(), 3.0);
  EXPECT_LT(reports.back().world_from_bone_rest.translation_mm.norm(), 1e-3);
  EXPECT_FALSE(reports.back().engaged);
  const Vec3 axis = run.model.world_from_plan.rotation.col(2);
  for (const auto& r : reports) EXPECT_LE(r.hand_force_n.dot(axis), 1e-6) << "tick " << r.tick;
}

TEST(ScapulaMount, AMountWithoutDampingDoesNotShake) {
  device::ScapulaMount mount = device::chest_wall_mount;
  mount.damping_n_s_mm.setZero();
  mount.angular_damping_n_mm_s_rad.setZero();
  SmallRun run = pressed(mount);
  const auto reports = run.run();
  double least = 1e9, most = 0.0;
  for (size_t i = 1500; i < reports.size(); ++i) {
    least = std::min(least, reports[i].thrust_n);
    most = std::max(most, reports[i].thrust_n);
  }
  EXPECT_LT(most - least, 0.02 * 52.0);
}

TEST(ScapulaMount, RigidLeavesTheBoneWhereItIs) {
  SmallRun run = pressed(std::nullopt, 52.0, 0.5);
  for (const auto& r : run.run()) {
    EXPECT_EQ(r.world_from_bone_rest.translation_mm, Vec3::Zero());
    EXPECT_EQ(r.world_from_bone_rest.rotation, Mat3::Identity());
  }
}

TEST(ScapulaMount, SameInputsGiveTheSameBits) {
  SmallRun a = pressed(device::chest_wall_mount), b = pressed(device::chest_wall_mount);
  const auto ra = a.run(), rb = b.run();
  EXPECT_EQ(ra.back().session_hash, rb.back().session_hash);
  EXPECT_EQ(a.bone.coverage_hash(), b.bone.coverage_hash());
}

}  // namespace
}  // namespace ream::test
