#include <gtest/gtest.h>

#include "geometry/pose.hpp"
#include "support/random_pose.hpp"
#include "support/seed.hpp"

namespace ream {
namespace {

constexpr uint32_t quantised_seed = 20262;

TEST(QuantisedPose, IsWithinHalfAStep) {
  SCOPED_TRACE(testing::Message() << "quantised_seed " << test::seed(quantised_seed));
  std::mt19937 random(test::seed(quantised_seed));
  for (int i = 0; i < 500; ++i) {
    const Pose pose = test::random_pose(random, 2000.0);
    const Pose back = dequantised(quantised(pose));
    EXPECT_LE((back.rotation - pose.rotation).cwiseAbs().maxCoeff(), 0.5 / 1073741824.0 + 1e-16);
    EXPECT_LE((back.translation_mm - pose.translation_mm).cwiseAbs().maxCoeff(), 0.5e-6 + 1e-12);
  }
}

TEST(QuantisedPose, OfAQuantisedPoseIsItself) {
  SCOPED_TRACE(testing::Message() << "quantised_seed " << test::seed(quantised_seed));
  std::mt19937 random(test::seed(quantised_seed));
  for (int i = 0; i < 500; ++i) {
    const QuantisedPose once = quantised(test::random_pose(random, 2000.0));
    EXPECT_EQ(quantised(dequantised(once)), once);
  }
}

TEST(QuantisedPose, HasKnownUnitsAndOrder) {
  Pose pose;
  pose.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  pose.translation_mm = {1.0, -0.000001, 2147.0};
  const QuantisedPose q = quantised(pose);
  constexpr int32_t one = 1 << 30;
  EXPECT_EQ(q.rotation_q30, (std::array<int32_t, 9>{0, -one, 0, one, 0, 0, 0, 0, one}));
  EXPECT_EQ(q.translation_nm, (std::array<int32_t, 3>{1'000'000, -1, 2'147'000'000}));
}

}  // namespace
}  // namespace ream
