#include "solve/box_element.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <bit>
#include <cmath>

#include "support/seed.hpp"

namespace ream::solve::test {
namespace {

using Displacements = Eigen::Matrix<double, 24, 1>;

const Vec3 edges(0.4, 0.5, 0.9);

Vec3 place(int corner) {
  return {(corner & 1) * edges.x(), (corner >> 1 & 1) * edges.y(), (corner >> 2) * edges.z()};
}

Displacements of(const Eigen::Matrix3d& gradient, const Vec3& shift) {
  Displacements u;
  for (int c = 0; c < 8; ++c) u.segment<3>(3 * c) = gradient * place(c) + shift;
  return u;
}

TEST(BoxElement, IsNotStrainedByMovingAndTurning) {
  const BoxElement box(edges, 0.3);
  EXPECT_LT((box.stiffness - box.stiffness.transpose()).norm(), 1e-12);
  Eigen::Matrix3d turn;
  turn << 0, -1, 2, 1, 0, -3, -2, 3, 0;
  EXPECT_LT((box.stiffness * of(turn, {5, 6, 7})).norm(), 1e-12);
  // Six motions without energy, and no more.
  const Eigen::SelfAdjointEigenSolver<BoxElement::Stiffness> eigen(box.stiffness);
  EXPECT_LT(std::abs(eigen.eigenvalues()[5]), 1e-12);
  EXPECT_GT(eigen.eigenvalues()[6], 1e-3);
}

/// Energy of an even strain is that of Hooke's law, here by Lame's constants.
TEST(BoxElement, HasTheEnergyOfAnEvenStrain) {
  std::mt19937_64 random(ream::test::seed(41));
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int trial = 0; trial < 50; ++trial) {
    const double poisson = 0.45 * number(random);
    Eigen::Matrix3d gradient;
    for (int i = 0; i < 9; ++i) gradient(i / 3, i % 3) = number(random);
    const Eigen::Matrix3d strain = 0.5 * (gradient + gradient.transpose());
    const double mu = 1.0 / (2.0 * (1.0 + poisson));
    const double lambda = poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    const double density = 0.5 * lambda * std::pow(strain.trace(), 2) + mu * strain.squaredNorm();
    const Displacements u = of(gradient, {number(random), number(random), number(random)});
    const double energy = 0.5 * u.dot(BoxElement(edges, poisson).stiffness * u);
    EXPECT_NEAR(energy, density * edges.prod(), 1e-12 * (1.0 + energy));
  }
}

TEST(BoxElement, HasAllOfItsEnergyInAllOfItsOctants) {
  const std::array<float, 256> shares = BoxElement(edges, 0.3).energy_shares();
  EXPECT_EQ(shares[0], 0.0f);
  EXPECT_NEAR(shares[255], 1.0, 1e-6);
  for (unsigned set = 1; set < 255; ++set) {
    // An even strain has as much in each.
    EXPECT_GE(shares[set], std::popcount(set) / 8.0 - 1e-6);
    EXPECT_LE(shares[set], 1.0 + 1e-6);
    EXPECT_GE(shares[set] + shares[255 - set], 1.0 - 1e-6);
    for (unsigned octant = 0; octant < 8; ++octant) EXPECT_LE(shares[set], shares[set | 1u << octant] + 1e-6);
  }
}

/// Of a few elements of very different moduli, put together.
TEST(BoxElement, BoundsTheEigenvaluesOfWhatIsMadeOfIt) {
  const BoxElement box(edges, 0.3);
  Eigen::Matrix<double, 36, 36> two = Eigen::Matrix<double, 36, 36>::Zero();
  const std::array<double, 2> moduli{1.0, 5000.0};
  for (int e = 0; e < 2; ++e)
    for (int i = 0; i < 24; ++i)
      for (int j = 0; j < 24; ++j)
        two(12 * e + i, 12 * e + j) += moduli[static_cast<size_t>(e)] * box.stiffness(i, j);
  const Eigen::VectorXd scale = two.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * two * scale.asDiagonal();
  const double greatest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled).eigenvalues()[35];
  EXPECT_LE(greatest, box.greatest_over_diagonal() * (1.0 + 1e-12));
  EXPECT_GT(greatest, 0.5 * box.greatest_over_diagonal());
}

TEST(BoxElement, IsTheSameInItsModes) {
  std::mt19937_64 random(ream::test::seed(42));
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const BoxElement box(edges, 0.3);
  const auto signs = [](const Displacements& values) {
    Displacements sums = Displacements::Zero();
    for (int m = 0; m < 8; ++m)
      for (int c = 0; c < 8; ++c)
        for (int k = 0; k < 3; ++k)
          sums[3 * m + k] +=
              (std::popcount(static_cast<unsigned>(m & c)) % 2 == 0 ? 1.0 : -1.0) * values[3 * c + k];
    return sums;
  };
  for (int trial = 0; trial < 20; ++trial) {
    Displacements u;
    for (int i = 0; i < 24; ++i) u[i] = number(random);
    const Displacements modes = signs(u);
    Displacements forces = Displacements::Zero();
    for (int parity = 0; parity < 8; ++parity)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          forces[3 * (parity ^ (1 << k)) + k] +=
              box.blocks[static_cast<size_t>(parity)][static_cast<size_t>(3 * k + l)] *
              modes[3 * (parity ^ (1 << l)) + l];
    EXPECT_LT((signs(forces) - box.stiffness * u).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace ream::solve::test
