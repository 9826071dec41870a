#include "geometry/pose.hpp"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <cmath>

#include "support/random_pose.hpp"
#include "support/seed.hpp"

namespace ream {
namespace {

using test::random_direction;
using test::random_pose;
using test::random_vector;
using test::rotation_about;

constexpr uint32_t pose_seed = 20261;

bool is_rotation(const Mat3& r) {
  return (r * r.transpose()).isApprox(Mat3::Identity(), 1e-12) && std::abs(r.determinant() - 1.0) < 1e-12;
}

TEST(Pose, ComposesAndInverts) {
  SCOPED_TRACE(testing::Message() << "pose_seed " << test::seed(pose_seed));
  std::mt19937 random(test::seed(pose_seed));
  for (int i = 0; i < 200; ++i) {
    const Pose a_from_b = random_pose(random), b_from_c = random_pose(random), c_from_d = random_pose(random);
    const Vec3 p = random_vector(random, 100.0);
    EXPECT_LT(((a_from_b * b_from_c).point(p) - a_from_b.point(b_from_c.point(p))).norm(), 1e-10);
    EXPECT_LT((a_from_b.inverse().point(a_from_b.point(p)) - p).norm(), 1e-10);
    EXPECT_LT(
        (((a_from_b * b_from_c) * c_from_d).point(p) - (a_from_b * (b_from_c * c_from_d)).point(p)).norm(),
        1e-10);
    EXPECT_LT((a_from_b.direction(p) - (a_from_b.point(p) - a_from_b.point(Vec3::Zero()))).norm(), 1e-10);
    const Pose nothing = a_from_b * a_from_b.inverse();
    EXPECT_TRUE(nothing.rotation.isIdentity(1e-12));
    EXPECT_LT(nothing.translation_mm.norm(), 1e-10);
  }
}

TEST(CayleyMap, TurnsAboutTheVectorByTwiceTheArcTangentOfItsHalf) {
  SCOPED_TRACE(testing::Message() << "pose_seed " << test::seed(pose_seed));
  std::mt19937 random(test::seed(pose_seed));
  for (const double length : {1e-9, 1e-4, 0.01, 0.3, 1.0, 3.0}) {
    const Vec3 axis = random_direction(random);
    const Mat3 expected = rotation_about(axis, 2.0 * std::atan(0.5 * length));
    EXPECT_LT((rotation_from_small_vector(axis * length) - expected).norm(), 1e-14) << length;
  }
  EXPECT_EQ(rotation_from_small_vector(Vec3::Zero()), Mat3::Identity());
}

TEST(CayleyMap, AgreesWithTheRotationVectorToThirdOrder) {
  std::mt19937 random(test::seed(pose_seed));
  const Vec3 axis = random_direction(random);
  // |2 atan(v/2) - v| <= v^3 / 12; the rotation matrix differs by at most sqrt(2) times that.
  for (const double length : {1e-3, 1e-2, 1e-1})
    EXPECT_LT((rotation_from_small_vector(axis * length) - rotation_about(axis, length)).norm(),
              std::sqrt(2.0) * length * length * length / 12.0 * 1.001);
}

TEST(CayleyMap, GoesThereAndBack) {
  SCOPED_TRACE(testing::Message() << "pose_seed " << test::seed(pose_seed));
  std::mt19937 random(test::seed(pose_seed));
  for (int i = 0; i < 500; ++i) {
    const Vec3 v = random_vector(random, i % 2 == 0 ? 1e-5 : 1.5);
    const Mat3 r = rotation_from_small_vector(v);
    EXPECT_TRUE(is_rotation(r));
    EXPECT_LT((small_vector_from_rotation(r) - v).norm(), 1e-14 + 1e-12 * v.norm());
  }
}

TEST(Quaternion, GoesThereAndBackForAllAngles) {
  SCOPED_TRACE(testing::Message() << "pose_seed " << test::seed(pose_seed));
  std::mt19937 random(test::seed(pose_seed));
  std::vector<Mat3> rotations{Mat3::Identity()};
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(-1, 0, 0)})
    for (const double angle : {0.5 * pi, pi, pi - 1e-9, -0.5 * pi})
      rotations.push_back(rotation_about(axis, angle));
  for (int i = 0; i < 500; ++i) rotations.push_back(random_pose(random).rotation);
  for (const Mat3& r : rotations) {
    const auto q = quaternion_from_rotation(r);
    EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1.0, 1e-12);
    EXPECT_GE(q[0], 0.0);
    EXPECT_LT((rotation_from_quaternion(q) - r).norm(), 1e-12);
    EXPECT_LT((Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix() - r).norm(), 1e-12)
        << "order is w x y z";
  }
}

TEST(Orthonormalized, CleansUpDriftAndKeepsARotation) {
  SCOPED_TRACE(testing::Message() << "pose_seed " << test::seed(pose_seed));
  std::mt19937 random(test::seed(pose_seed));
  std::uniform_real_distribution<double> noise(-1e-6, 1e-6);
  for (int i = 0; i < 100; ++i) {
    const Mat3 r = random_pose(random).rotation;
    EXPECT_LT((orthonormalized(r) - r).norm(), 1e-14);
    const Mat3 drifted = r + Mat3::NullaryExpr([&] { return noise(random); });
    EXPECT_TRUE(is_rotation(orthonormalized(drifted)));
    EXPECT_LT((orthonormalized(drifted) - r).norm(), 1e-5);
  }
}

TEST(RotationWithZAlong, PointsThereWhateverTheLength) {
  SCOPED_TRACE(testing::Message() << "pose_seed " << test::seed(pose_seed));
  std::mt19937 random(test::seed(pose_seed));
  std::vector<Vec3> directions{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), -Vec3::UnitX(), -Vec3::UnitZ()};
  for (int i = 0; i < 100; ++i) directions.push_back(random_direction(random));
  for (const Vec3& d : directions) {
    const Mat3 r = rotation_with_z_along(42.0 * d);
    EXPECT_TRUE(is_rotation(r));
    EXPECT_LT((r.col(2) - d).norm(), 1e-14);
    EXPECT_EQ(r, rotation_with_z_along(42.0 * d));
  }
}

}  // namespace
}  // namespace ream
