#include <gtest/gtest.h>

#include "device/script/script.hpp"

namespace ream::device {
namespace {

TEST(Timeline, ForceIsLinearBetweenEntriesAndConstantOutside) {
  const std::vector<TimedForce> profile = {{1.0, 10.0}, {2.0, 30.0}, {4.0, -10.0}};
  EXPECT_EQ(force_at({}, 1.0), 0.0);
  EXPECT_EQ(force_at(profile, 0.0), 10.0);
  EXPECT_EQ(force_at(profile, 1.0), 10.0);
  EXPECT_DOUBLE_EQ(force_at(profile, 1.25), 15.0);
  EXPECT_EQ(force_at(profile, 2.0), 30.0);
  EXPECT_DOUBLE_EQ(force_at(profile, 3.5), 0.0);
  EXPECT_EQ(force_at(profile, 4.0), -10.0);
  EXPECT_EQ(force_at(profile, 99.0), -10.0);
}

TEST(Timeline, PosesAreLinearBetweenEntriesAndConstantOutside) {
  const std::vector<TimedPose> poses = {{1.0, Vec3(0, 0, -4), Vec3(0, 0, 0)},
                                        {3.0, Vec3(2, 0, 4), Vec3(0, 0.4, 0)}};
  EXPECT_EQ(pose_at(poses, 0.0).position_mm, Vec3(0, 0, -4));
  EXPECT_EQ(pose_at(poses, 5.0).position_mm, Vec3(2, 0, 4));
  const TimedPose half = pose_at(poses, 2.0);
  EXPECT_EQ(half.t_s, 2.0);
  EXPECT_LT((half.position_mm - Vec3(1, 0, 0)).norm(), 1e-14);
  EXPECT_LT((half.rotation_vector_rad - Vec3(0, 0.2, 0)).norm(), 1e-14);
}

TEST(Timeline, ButtonsStayAsLastSet) {
  const std::vector<TimedButtons> buttons = {{1.0, false, false}, {2.0, true, true}};
  EXPECT_TRUE(buttons_at(buttons, 0.5).spindle);
  EXPECT_FALSE(buttons_at(buttons, 0.5).pause);
  EXPECT_FALSE(buttons_at(buttons, 1.0).spindle) << "an entry holds from its own time on";
  EXPECT_FALSE(buttons_at(buttons, 1.999).spindle);
  EXPECT_TRUE(buttons_at(buttons, 50.0).spindle);
  EXPECT_TRUE(buttons_at(buttons, 50.0).pause);
}

}  // namespace
}  // namespace ream::device
