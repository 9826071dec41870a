#include "force/coupling.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace ream::force {
namespace {

Resistance facing(const Vec3& outward) {
  Resistance r;
  r.outward = outward;
  return r;
}

using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

TEST(Friction, HasTheSizeOfCoulombsWhateverTheSpeed) {
  for (const double speed : {0.1, 1.0, 30.0}) {
    Resistance r = facing(-Vec3::UnitZ());
    add_friction({Vec3::Zero(), 52.0, speed, 0.0, 6.0}, r);
    EXPECT_NEAR(r.cutting[0] * speed, friction_coefficient * 52.0, 1e-9);
    EXPECT_NEAR(r.cutting[7] * speed, friction_coefficient * 52.0, 1e-9);
    EXPECT_NEAR(r.cutting[14], 0.0, 1e-9);
  }
}

TEST(Friction, ASpinningCapDragsLittle) {
  // 156 rpm at 10 mm is 163 mm/s: moving it sideways by 1 mm/s meets 1/163 of mu F.
  Resistance r = facing(-Vec3::UnitZ());
  add_friction({Vec3::Zero(), 52.0, 1.0, 16.336, 10.0}, r);
  EXPECT_NEAR(r.cutting[0], friction_coefficient * 52.0 / 163.36, 1e-3);
}

TEST(Friction, HoldsAgainstTwistingAboutTheAxis) {
  Resistance r = facing(-Vec3::UnitZ());
  add_friction({Vec3::Zero(), 52.0, 0.0, 0.01, 6.0}, r);
  // 0.01 rad/s at 6 mm slides by 0.06 mm/s: the torque is mu F r.
  EXPECT_NEAR(r.cutting[35] * 0.01, friction_coefficient * 52.0 * 6.0, 1e-6);
}

TEST(Friction, ActsWhereTheSurfaceTouches) {
  Resistance r = facing(-Vec3::UnitZ());
  const Vec3 point_mm(4.0, 0.0, -1.0);
  add_friction({point_mm, 20.0, 5.0, 0.0, 0.0}, r);
  const Eigen::Map<const Matrix6> b(r.cutting.data());
  Eigen::Matrix<double, 6, 1> twist;
  twist << 0.0, 5.0, 0.0, 0.0, 0.0, 0.0;
  const Eigen::Matrix<double, 6, 1> wrench = b * twist;
  const Vec3 force_n = wrench.head<3>(), torque_n_mm = wrench.tail<3>();
  EXPECT_LT((force_n - Vec3(0, friction_coefficient * 20.0, 0)).norm(), 1e-12);
  EXPECT_LT((torque_n_mm - point_mm.cross(force_n)).norm(), 1e-12);
}

TEST(Friction, OnlyTakesEnergy) {
  Resistance r = facing(Vec3(0.6, 0.0, -0.8));
  add_friction({Vec3(3.0, -1.0, -2.0), 30.0, 2.0, 1.0, 4.0}, r);
  const Eigen::Map<const Matrix6> b(r.cutting.data());
  EXPECT_LT((b - b.transpose()).norm(), 1e-12);
  EXPECT_GE(Eigen::SelfAdjointEigenSolver<Matrix6>(b).eigenvalues().minCoeff(), -1e-9);
}

TEST(Friction, NoneWithoutPressing) {
  Resistance r = facing(-Vec3::UnitZ());
  add_friction({Vec3::Zero(), 0.0, 1.0, 16.0, 6.0}, r);
  EXPECT_EQ(r.cutting, Mat6{});
}

}  // namespace
}  // namespace ream::force
