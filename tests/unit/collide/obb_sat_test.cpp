#include "collide/contact/broad_phase.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/random_pose.hpp"
#include "support/seed.hpp"

namespace ream::test {
namespace {

/// Independent reference: distance between two boxes by alternating projection onto each (convex sets).
double box_distance_mm(const Obb& a, const Obb& b) {
  const auto clamp_to = [](const Obb& box, const Vec3& p) -> Vec3 {
    const Vec3 local = box.frame_from_box.inverse().point(p);
    return box.frame_from_box.point(local.cwiseMax(-box.half_size).cwiseMin(box.half_size));
  };
  Vec3 p = a.frame_from_box.translation_mm, q = p;
  for (int i = 0; i < 20000; ++i) {
    q = clamp_to(b, p);
    p = clamp_to(a, q);
  }
  return (p - q).norm();
}

TEST(ObbSat, AgreesWithTheDistanceBetweenRandomBoxes) {
  const uint32_t seed = test::seed(20260101);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> half(0.5, 4.0);
  int apart = 0, together = 0;
  for (int i = 0; i < 300; ++i) {
    Obb a, b;
    a.frame_from_box = random_pose(random, 3.0);
    b.frame_from_box = random_pose(random, 3.0);
    a.half_size = Vec3(half(random), half(random), half(random));
    b.half_size = Vec3(half(random), half(random), half(random));
    const double distance = box_distance_mm(a, b);
    if (distance > 0.02) {
      EXPECT_FALSE(collide::overlap(a, b)) << "seed " << seed << " case " << i << " distance " << distance;
      ++apart;
    } else if (distance < 1e-6) {
      EXPECT_TRUE(collide::overlap(a, b)) << "seed " << seed << " case " << i;
      ++together;
    }
  }
  EXPECT_GT(apart, 30);
  EXPECT_GT(together, 30);
}

TEST(BroadPhase, VoiHoldsEveryPointOfBothBoxes) {
  const uint32_t seed = test::seed(7);
  std::mt19937 random(seed);
  const Aabb bone{Vec3(0, 0, 0), Vec3(10, 8, 6)}, tool{Vec3(-3, -3, -5), Vec3(3, 3, 1)};
  for (int i = 0; i < 200; ++i) {
    const Pose grid_from_tool = random_pose(random, 12.0);
    const collide::Voi voi = collide::broad_phase(bone, tool, grid_from_tool, 0.1);
    for (int k = 0; k < 200; ++k) {
      const Vec3 p = tool.centre() + random_vector(random, 1.0).cwiseProduct(tool.half_size());
      if (!bone.contains(grid_from_tool.point(p))) continue;
      EXPECT_TRUE(voi.touching) << "seed " << seed << " case " << i;
      EXPECT_TRUE(voi.box_tool_mm.contains(p)) << "seed " << seed << " case " << i;
    }
  }
}

}  // namespace
}  // namespace ream::test
