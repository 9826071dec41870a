#include "geometry/box.hpp"

#include <gtest/gtest.h>

#include "support/random_pose.hpp"
#include "support/seed.hpp"

namespace ream {
namespace {

constexpr uint32_t box_seed = 20263;

Vec3 corner(const Aabb& box, int i) {
  return {(i & 1) ? box.max.x() : box.min.x(), (i & 2) ? box.max.y() : box.min.y(),
          (i & 4) ? box.max.z() : box.min.z()};
}

Aabb around(const Vec3& a, const Vec3& b) {
  Aabb box;
  box.include(a);
  box.include(b);
  return box;
}

TEST(Aabb, IsEmptyUntilSomethingIsIncluded) {
  Aabb box;
  EXPECT_TRUE(box.empty());
  box.include({1, 2, 3});
  EXPECT_FALSE(box.empty());
  EXPECT_EQ(box.min, box.max);
  EXPECT_TRUE(box.contains({1, 2, 3}));
  EXPECT_FALSE(box.contains({1, 2, 3.001}));
}

TEST(Aabb, MeasuresItself) {
  const Aabb box = around({-1, 4, 2}, {3, 0, 8});
  EXPECT_EQ(box.centre(), Vec3(1, 2, 5));
  EXPECT_EQ(box.half_size(), Vec3(2, 2, 3));
  EXPECT_EQ(box.grown(0.5).half_size(), Vec3(2.5, 2.5, 3.5));
  EXPECT_EQ(box.grown(0.5).centre(), box.centre());
}

TEST(Aabb, IntersectionHoldsExactlyThePointsOfBoth) {
  SCOPED_TRACE(testing::Message() << "box_seed " << test::seed(box_seed));
  std::mt19937 random(test::seed(box_seed));
  for (int i = 0; i < 200; ++i) {
    const Aabb a = around(test::random_vector(random, 5), test::random_vector(random, 5));
    const Aabb b = around(test::random_vector(random, 5), test::random_vector(random, 5));
    const Aabb common = a.intersection(b);
    for (int k = 0; k < 50; ++k) {
      const Vec3 p = test::random_vector(random, 5);
      EXPECT_EQ(common.contains(p), a.contains(p) && b.contains(p));
    }
  }
  EXPECT_TRUE(around({0, 0, 0}, {1, 1, 1}).intersection(around({2, 0, 0}, {3, 1, 1})).empty());
}

TEST(Aabb, TransformedIsTheSmallestBoxAroundTheCorners) {
  SCOPED_TRACE(testing::Message() << "box_seed " << test::seed(box_seed));
  std::mt19937 random(test::seed(box_seed));
  for (int i = 0; i < 200; ++i) {
    const Aabb box = around(test::random_vector(random, 50), test::random_vector(random, 50));
    const Pose a_from_b = test::random_pose(random);
    Aabb expected;
    for (int k = 0; k < 8; ++k) expected.include(a_from_b.point(corner(box, k)));
    const Aabb found = box.transformed(a_from_b);
    EXPECT_LT((found.min - expected.min).norm(), 1e-10);
    EXPECT_LT((found.max - expected.max).norm(), 1e-10);
  }
}

TEST(Obb, HasTheCornersOfItsBox) {
  SCOPED_TRACE(testing::Message() << "box_seed " << test::seed(box_seed));
  std::mt19937 random(test::seed(box_seed));
  for (int i = 0; i < 100; ++i) {
    const Aabb box = around(test::random_vector(random, 50), test::random_vector(random, 50));
    const Pose frame_from_aabb = test::random_pose(random);
    const Obb obb = Obb::from(box, frame_from_aabb);
    for (int k = 0; k < 8; ++k) {
      const Vec3 signs((k & 1) ? 1 : -1, (k & 2) ? 1 : -1, (k & 4) ? 1 : -1);
      const Vec3 found = obb.frame_from_box.point(obb.half_size.cwiseProduct(signs));
      EXPECT_LT((found - frame_from_aabb.point(corner(box, k))).norm(), 1e-10);
    }
  }
}

}  // namespace
}  // namespace ream
