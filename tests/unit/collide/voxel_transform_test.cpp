#include "collide/grid_transform.hpp"

#include <gtest/gtest.h>

#include "support/random_bone.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"

namespace ream::collide {
namespace {

constexpr uint32_t voxel_transform_seed = 20314;

TEST(VoxelTransform, AgreesWithDoublesToAHundredthOfAVoxel) {
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(voxel_transform_seed));
  std::mt19937 random(test::seed(voxel_transform_seed));
  for (const auto& [dims, spacing, unit_mm] :
       {std::tuple(Vec3i(600, 384, 464), 0.0835, 0.0025), std::tuple(Vec3i(1024, 1024, 1024), 0.05, 0.004),
        std::tuple(Vec3i(64, 64, 64), 0.9, 0.01), std::tuple(Vec3i(2040, 8, 8), 0.02, 0.004)}) {
    const voxel::VoxelGrid grid = test::grid_of(dims, Vec3(spacing, 1.1 * spacing, spacing));
    for (int i = 0; i < 200; ++i) {
      Pose pose = test::random_pose(random, 0.0);
      pose.translation_mm = 0.5 * grid.bounds_mm().max + test::random_vector(random, 3.0);
      const QuantisedPose q = quantised(pose);
      const VoxelTransform transform = voxel_transform(q, grid, unit_mm);
      const auto reach = static_cast<int>(0.4 * grid.bounds_mm().max.minCoeff() / unit_mm);
      const Vec3i origin(static_cast<int>(random() % (2 * reach)) - reach,
                         static_cast<int>(random() % (2 * reach)) - reach,
                         static_cast<int>(random() % (2 * reach)) - reach);
      const Vec3i place(static_cast<int>(random() % 512), static_cast<int>(random() % 512),
                        static_cast<int>(random() % 512));
      const Vec3 expected =
          dequantised(q).point((origin + place).cast<double>() * unit_mm).cwiseQuotient(grid.spacing_mm);
      const auto base = transform.base(origin);
      for (int axis = 0; axis < 3; ++axis) {
        int64_t sum = base[static_cast<size_t>(axis)];
        for (int j = 0; j < 3; ++j) {
          const int32_t factor = transform.per_unit[static_cast<size_t>(3 * axis + j)];
          ASSERT_LE(std::abs(factor), 32767);
          sum += int64_t{factor} * place[j];
        }
        ASSERT_LE(std::abs(sum), int64_t{INT32_MAX}) << "does not fit 32 bits";
        ASSERT_NEAR(static_cast<double>(sum) / (1 << transform.bits), expected[axis], 0.01);
      }
    }
  }
}

TEST(Odometer, NeverReadsLessThanTheWayOfAnyPointOfTheBox) {
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(voxel_transform_seed));
  std::mt19937 random(test::seed(voxel_transform_seed));
  const Aabb box{Vec3(-3, -4, -1), Vec3(5, 2, 7)};
  Odometer odometer(box, 0.25);
  Pose pose;
  EXPECT_EQ(odometer.advance(pose), 0.0) << "the first pose is where the way begins";
  for (int i = 0; i < 500; ++i) {
    const double before = odometer.voxels();
    Pose next{orthonormalized(pose.rotation * rotation_from_small_vector(test::random_vector(random, 0.2))),
              pose.translation_mm + test::random_vector(random, 1.0)};
    const double read = odometer.advance(next) - before;
    for (int k = 0; k < 50; ++k) {
      const Vec3 in = box.centre() + test::random_vector(random, 1.0).cwiseProduct(box.half_size());
      ASSERT_GE(read * 0.25, (next.point(in) - pose.point(in)).norm() - 1e-12);
    }
    pose = next;
  }
}

}  // namespace
}  // namespace ream::collide
