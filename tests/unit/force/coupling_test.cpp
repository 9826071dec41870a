#include "force/coupling.hpp"
#include "support/seed.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace ream::force {
namespace {

constexpr double tick_s = 1e-3;

/// Flat contact across the tool axis: resists axial motion and tilting, like a seated cap.
Resistance axial(double resistance_n_s_mm) {
  Resistance r;
  r.cutting[14] = resistance_n_s_mm;
  r.cutting[21] = r.cutting[28] = 100.0 * resistance_n_s_mm;
  r.outward = -Vec3::UnitZ();
  return r;
}

TEST(Coupling, AxialCreepIsTheMaxwellElement) {
  // Backward Euler of spring and damper in series: F = K d / (1 + K T / b), motion T F / b.
  const CouplingParameters p{2.0, 2000.0, 26.0};
  const double b = 2000.0, k = 52.0, d = 1.0;
  const CouplingStep step = couple(p, axial(b), {0, 0, d, 0, 0, 0}, tick_s);
  const double force = k * d / (1.0 + k * tick_s / b);
  EXPECT_NEAR(step.wrench_on_tool[2], force, 1e-9);
  EXPECT_NEAR(step.tool_motion[2], tick_s * force / b, 1e-12);
}

TEST(Coupling, WithoutResistanceTheToolFollowsTheHandle) {
  const Vec6 delta{0.1, -0.2, 0.3, 0.01, 0.02, -0.03};
  const CouplingStep step = couple({2.0, 2000.0, 1.0}, Resistance{}, delta, tick_s);
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(step.tool_motion[i], delta[i], 1e-12);
    EXPECT_NEAR(step.wrench_on_tool[i], 0.0, 1e-9);
  }
}

TEST(Coupling, WithdrawingIsNeverTensile) {
  const CouplingStep step = couple({2.0, 2000.0, 1.0}, axial(2000.0), {0, 0, -0.5, 0, 0, 0}, tick_s);
  EXPECT_NEAR(step.wrench_on_tool[2], 0.0, 1e-12);
  EXPECT_NEAR(step.tool_motion[2], -0.5, 1e-12);
}

TEST(Coupling, ASeatedCapResistsTilting) {
  const CouplingStep step = couple({2.0, 2000.0, 1.0}, axial(2000.0), {0, 0, 0, 0.01, 0, 0}, tick_s);
  EXPECT_GT(step.wrench_on_tool[3], 0.99 * 2000.0 * 0.01);
  EXPECT_LT(step.tool_motion[3], 1e-4);
}

TEST(Coupling, BlockedDirectionsDoNotMove) {
  Resistance r;
  r.guiding[0] = r.guiding[7] = 5.0;
  const CouplingStep step = couple({2.0, 2000.0, 1.0}, r, {1.0, -1.0, 1.0, 0, 0, 0}, tick_s);
  EXPECT_LT(std::abs(step.tool_motion[0]), 1e-6);
  EXPECT_LT(std::abs(step.tool_motion[1]), 1e-6);
  EXPECT_NEAR(step.tool_motion[2], 1.0, 1e-9);
}

TEST(Coupling, SolvesTheSixBySixSystem) {
  const uint32_t seed = test::seed(3);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int trial = 0; trial < 100; ++trial) {
    Eigen::Matrix<double, 6, 6> a;
    for (int i = 0; i < 36; ++i) a.data()[i] = u(random);
    const Eigen::Matrix<double, 6, 6> b = a * a.transpose() * 500.0;
    Eigen::Matrix<double, 6, 1> delta;
    for (int i = 0; i < 6; ++i) delta[i] = 0.1 * u(random);
    Resistance r;
    Vec6 d{};
    for (size_t i = 0; i < 6; ++i) {
      d[i] = delta[static_cast<int>(i)];
      for (size_t j = 0; j < 6; ++j) r.cutting[6 * i + j] = b(static_cast<int>(i), static_cast<int>(j));
    }
    Eigen::Matrix<double, 6, 1> k;
    k << 10, 10, 10, 900, 900, 900;
    const Eigen::Matrix<double, 6, 6> system = b + Eigen::Matrix<double, 6, 6>((k * tick_s).asDiagonal());
    const Eigen::Matrix<double, 6, 1> twist =
        system.ldlt().solve(Eigen::Matrix<double, 6, 1>(k.cwiseProduct(delta)));
    const CouplingStep step = couple({10.0, 900.0, 1.0}, r, d, tick_s);
    for (size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(step.tool_motion[i], twist[static_cast<int>(i)] * tick_s, 1e-9)
          << "seed " << seed << " trial " << trial;
  }
}

}  // namespace
}  // namespace ream::force
