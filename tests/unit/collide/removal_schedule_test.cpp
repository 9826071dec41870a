#include "collide/removal/removal_schedule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>

#include "support/cut_bricks.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"
#include "support/test_bone.hpp"

namespace ream::test {
namespace {

/// Fine bone and a broad tool: thousands of bricks are due at a first contact.
struct ScheduleScene {
  ScheduleScene()
      : bone(slab({160, 160, 80}, 0.1, 6.0, 0.6)),
        profile(shell::swept_profile(shell::make_tool("sphere 12,7").profile,
                                     collide::RemovalSchedule::needed_margin_mm(bone.grid))),
        removal(collide::make_removal_cpu({profile, bone})),
        schedule(profile, bone) {}

  /// One tick in which the tool cuts; returns how many bricks were visited.
  size_t tick(const QuantisedPose& pose) {
    const auto due = schedule.due(pose);
    const std::vector<uint32_t> bricks(due.begin(), due.end());
    const CutAnswer answer = cut_bricks(*removal, pose, bricks);
    for (size_t i = 0; i < bricks.size(); ++i) {
      schedule.cut_done(i, answer.outcomes[i]);
      ++visits[bricks[i]];
    }
    changed = answer.sums.changed_bricks;
    return bricks.size();
  }
  /// Bricks that would change if they were all cut now.
  size_t unfinished(const QuantisedPose& pose) {
    voxel::BoneModel copy = bone;
    std::vector<uint32_t> all(bone.grid.brick_count());
    for (uint32_t b = 0; b < all.size(); ++b) all[b] = b;
    return cut_bricks(*collide::make_removal_cpu({profile, copy}), pose, all).sums.changed_bricks;
  }

  voxel::BoneModel bone;
  shell::SweptProfile profile;
  std::unique_ptr<collide::Removal> removal;
  collide::RemovalSchedule schedule;
  std::map<uint32_t, int> visits;
  uint32_t changed = 0;
};

Pose above(double z_mm, const Vec3& shift = Vec3::Zero()) {
  return {rotation_with_z_along(-Vec3::UnitZ()), Vec3(8, 8, z_mm) + shift};
}

TEST(RemovalSchedule, ASuddenDeepContactIsWorkedOffInTurnAndBounded) {
  ScheduleScene s;
  const QuantisedPose pose = quantised(above(3.0));
  const size_t bricks = s.unfinished(pose);
  ASSERT_GT(bricks, 4 * collide::RemovalSchedule::max_bricks_per_tick);
  size_t ticks = 0, visited = 0;
  while (s.unfinished(pose) > 0 && ticks < 200) {
    const size_t count = s.tick(pose);
    EXPECT_LE(count, collide::RemovalSchedule::max_bricks_per_tick);
    visited += count;
    ++ticks;
  }
  for (const auto& [brick, times] : s.visits) EXPECT_LE(times, 1) << "brick " << brick << " had its turn";
  // A quarter in the first tick, then 128 a tick of those that are due.
  EXPECT_LE(ticks, visited / collide::RemovalSchedule::max_bricks_per_tick + 2);
  std::cout << bricks << " bricks to cut, " << visited << " visited in " << ticks << " ticks\n";
}

TEST(RemovalSchedule, WhileTheToolGoesOnNoBrickWaitsLongerThanItsTurn) {
  const uint32_t seed = test::seed(71);
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  ScheduleScene s;
  Vec3 shift = Vec3::Zero();
  double z = 5.2;
  for (int t = 0; t < 400; ++t) {
    // Up to 0.2 voxels a tick in any direction: ten times the feed of a strong push.
    shift += random_vector(random, 0.01).cwiseProduct(Vec3(1, 1, 0));
    z -= 0.002;
    s.tick(quantised(above(z, shift)));
  }
  // The tool halts. What is left is cut within one round of all bricks near it.
  const QuantisedPose pose = quantised(above(z, shift));
  size_t ticks = 0;
  for (; ticks < 100 && s.tick(pose) != 0; ++ticks) {
  }
  EXPECT_LT(ticks, 40u) << "seed " << seed;
  voxel::BoneModel rest = s.bone;
  std::vector<uint32_t> all(rest.grid.brick_count());
  for (uint32_t b = 0; b < all.size(); ++b) all[b] = b;
  cut_bricks(*collide::make_removal_cpu({s.profile, rest}), pose, all);
  for (size_t i = 0; i < rest.coverage.size(); ++i)
    ASSERT_LE(s.bone.coverage[i] - rest.coverage[i], 5) << "1/64 voxel is 4 levels; seed " << seed;
}

TEST(RemovalSchedule, BricksBehindASlackAreLeftAloneUntilTheToolHasMovedAsFar) {
  ScheduleScene s;
  const QuantisedPose pose = quantised(above(5.3));
  while (s.tick(pose) != 0) {
  }
  EXPECT_EQ(s.tick(pose), 0u) << "nothing moves, nothing is due";
  size_t visited = 0;
  for (int t = 1; t <= 100; ++t) visited += s.tick(quantised(above(5.3 - 1e-5 * t)));
  // 1 um in all is two thirds of 1/64 voxel: two thirds of the bricks at the surface, each once.
  EXPECT_LT(visited, 2 * s.unfinished(quantised(above(5.2))));
  for (const auto& [brick, times] : s.visits) EXPECT_LE(times, 4) << "brick " << brick;
}

}  // namespace
}  // namespace ream::test
