#include <gtest/gtest.h>

#include <random>

#include "collide/contact/contact_schedule.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"
#include "support/test_bone.hpp"

namespace ream::test {
namespace {

struct Walk {
  explicit Walk(unsigned seed)
      : random(seed),
        bone(slab({64, 64, 64}, 0.25, 8.0, 1.4)),
        tool(shell::make_tool("ellipse 6,3 nipple 1,2")),
        contact(collide::make_contact_shell(shell::make_point_shell(tool, 0.3), 0.25)),
        distance(voxel::brick_distance(bone)),
        cells(bone) {}

  collide::NarrowPhaseInput input() const { return {contact, bone, distance, cells}; }

  collide::ContactSums look(collide::NarrowPhase& phase, const QuantisedPose& pose) const {
    const collide::Voi voi =
        collide::broad_phase(cells.bounds_mm(), contact.bounds_mm, dequantised(pose), 0.25);
    collide::ContactSums sums;
    EXPECT_TRUE(phase.contact(pose, voi, sums));
    return sums;
  }

  /// Takes bone away somewhere, as removal does.
  void cut_somewhere() {
    const auto brick = static_cast<uint32_t>(random() % bone.grid.brick_count());
    uint8_t* coverage = bone.coverage.data() + bone.grid.brick_base(brick);
    for (int i = 0; i < 40; ++i) coverage[random() % voxel::brick_voxels] = 0;
    cells.set(brick, voxel::SolidCells::word_of(coverage));
  }

  std::mt19937 random;
  voxel::BoneModel bone;
  shell::Tool tool;
  collide::ContactShell contact;
  voxel::BrickDistance distance;
  voxel::SolidCells cells;
};

/// A narrow phase that has never looked before has everything due.
collide::ContactSums fresh_look(const Walk& walk, const QuantisedPose& pose) {
  return walk.look(*collide::make_narrow_phase_cpu(walk.input()), pose);
}

TEST(ContactSchedule, WhatIsLeftAloneNeverTouches) {
  const uint32_t seed = test::seed(20313);
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  Walk walk(seed);
  const auto phase = collide::make_narrow_phase_cpu(walk.input());
  const auto portable = collide::make_narrow_phase_cpu(walk.input(), collide::Instructions::portable);
  Pose pose{rotation_with_z_along(-Vec3::UnitZ()), Vec3(8, 8, 9.0)};
  int64_t engaged = 0;
  int free_looks = 0;
  for (int i = 0; i < 3000; ++i) {
    // Mostly creeping, now and then a leap.
    const double step_mm = i % 97 == 0 ? 2.0 : i % 5 == 0 ? 0.05 : 0.004;
    pose.translation_mm += random_vector(walk.random, step_mm);
    pose.translation_mm = pose.translation_mm.cwiseMax(Vec3(4, 4, 6)).cwiseMin(Vec3(12, 12, 10));
    pose.rotation = orthonormalized(pose.rotation *
                                    rotation_from_small_vector(random_vector(walk.random, 0.05 * step_mm)));
    if (i % 7 == 0) walk.cut_somewhere();
    const QuantisedPose q = quantised(pose);
    const collide::ContactSums sums = walk.look(*phase, q);
    ASSERT_EQ(sums, fresh_look(walk, q)) << "look " << i;
    ASSERT_EQ(sums, walk.look(*portable, q)) << "look " << i;
    engaged += sums.engaged();
    free_looks += sums.engaged() == 0;
  }
  EXPECT_GT(engaged, 100000);
  EXPECT_GT(free_looks, 100) << "the tool never hung in the air: nothing was tested";
}

TEST(ContactSchedule, AToolAtRestIsVisitedWhereItTouchesAndHardlyElsewhere) {
  Walk walk(1);
  collide::ContactSchedule schedule(walk.input());
  collide::ContactView view = collide::contact_view(walk.input());
  const collide::ContactKernels functions = collide::best_contact_kernels();
  const QuantisedPose pose = quantised({rotation_with_z_along(-Vec3::UnitZ()), Vec3(8, 8, 7.5)});
  const collide::Voi voi =
      collide::broad_phase(walk.cells.bounds_mm(), walk.contact.bounds_mm, dequantised(pose), 0.25);
  const collide::VoxelTransform transform =
      collide::voxel_transform(pose, walk.bone.grid, walk.contact.place_unit_mm);
  view.look_from(transform);
  std::vector<uint8_t> touched(walk.contact.chunk_count());
  size_t first_due = 0, last_due = 0, last_touched = 0;
  for (int i = 0; i < 200; ++i) {
    const auto due = schedule.due(pose, voi, transform);
    collide::ContactSums sums;
    functions.look(view, due, touched.data(), sums);
    schedule.visited(view, functions.is_clear, touched);
    if (i == 0) first_due = due.size();
    last_due = due.size();
    last_touched =
        static_cast<size_t>(std::count(touched.begin(), touched.begin() + static_cast<long>(due.size()), 1));
  }
  EXPECT_GT(last_touched, 20u);
  EXPECT_LT(2 * (last_due - last_touched), first_due - last_touched)
      << first_due << " due at first, " << last_due << " at last, " << last_touched << " touch";
}

}  // namespace
}  // namespace ream::test
