#include "solve/elastic_grid.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numeric>
#include <random>

#include "solve/elastic_operator.hpp"
#include "support/seed.hpp"

namespace ream::solve::test {
namespace {

const Vec3 cell(0.3, 0.4, 0.5);
const Vec3i dims(5, 4, 7);

std::vector<float> random_moduli(uint64_t seed, double fill) {
  std::mt19937_64 random(seed);
  std::vector<float> moduli;
  for (int i = 0; i < dims.prod(); ++i) {
    const bool filled = static_cast<double>(random() % 1000) < 1000.0 * fill;
    moduli.push_back(filled ? static_cast<float>(100 + random() % 10000) : 0.0f);
  }
  return moduli;
}

std::vector<double> random_displacements(const ElasticGrid& grid, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<double> displacements(3 * grid.corners());
  for (double& value : displacements) value = number(random);
  return displacements;
}

/// Element by element, by the whole matrix of the box.
Eigen::VectorXd forces_by_the_book(const std::vector<float>& moduli, const ElasticGrid& grid,
                                   const std::vector<double>& displacements) {
  const BoxElement box(cell, 0.3);
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(displacements.size()));
  for (int i = 0; i < dims.prod(); ++i) {
    const float modulus = moduli[static_cast<size_t>(i)];
    if (modulus == 0.0f) continue;
    const Vec3i at(i % dims.x(), i / dims.x() % dims.y(), i / (dims.x() * dims.y()));
    for (int c = 0; c < 8; ++c)
      for (int d = 0; d < 8; ++d)
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l) {
            const int to = grid.corner_at(at + Vec3i(c & 1, c >> 1 & 1, c >> 2));
            const int from = grid.corner_at(at + Vec3i(d & 1, d >> 1 & 1, d >> 2));
            forces[3 * to + k] += double{modulus} * box.stiffness(3 * c + k, 3 * d + l) *
                                  displacements[static_cast<size_t>(3 * from + l)];
          }
  }
  return forces;
}

TEST(ElasticGrid, NumbersTheCornersThatElementsHave) {
  std::vector<float> moduli(static_cast<size_t>(dims.prod()), 0.0f);
  moduli[0] = moduli[1] = 7.0f;
  const ElasticGrid grid(dims, cell, moduli);
  EXPECT_EQ(grid.elements(), 2u);
  EXPECT_EQ(grid.corners(), 12u);
  EXPECT_EQ(grid.corner_at({2, 1, 1}), 11);
  EXPECT_EQ(grid.corner_at({3, 0, 0}), -1);
  EXPECT_EQ(grid.place_of(5), Vec3i(2, 1, 0));
}

TEST(ElasticGrid, HasTheForcesOfItsElements) {
  const uint64_t seed = ream::test::seed(43);
  for (const double fill : {0.2, 0.6, 1.0}) {
    const std::vector<float> moduli = random_moduli(seed, fill);
    const ElasticGrid grid(dims, cell, moduli);
    const std::vector<double> displacements = random_displacements(grid, seed + 1);
    const Eigen::VectorXd expected = forces_by_the_book(moduli, grid, displacements);
    ThreadPool pool(2);
    std::vector<double> forces(displacements.size());
    ElasticOperator<double>(grid, 0.3).apply(displacements, forces, pool);
    const std::vector<float> singles(displacements.begin(), displacements.end());
    std::vector<float> of_singles(displacements.size());
    ElasticOperator<float>(grid, 0.3).apply(singles, of_singles, pool);
    for (size_t i = 0; i < forces.size(); ++i) {
      EXPECT_NEAR(forces[i], expected[static_cast<Eigen::Index>(i)],
                  1e-9 * expected.lpNorm<Eigen::Infinity>());
      EXPECT_NEAR(of_singles[i], forces[i], 1e-5 * expected.lpNorm<Eigen::Infinity>());
    }
  }
}

TEST(ElasticGrid, HasTheSameBitsOnAnyNumberOfThreads) {
  const std::vector<float> moduli = random_moduli(5, 0.7);
  const ElasticGrid grid(dims, cell, moduli);
  const std::vector<double> displacements = random_displacements(grid, 6);
  const ElasticOperator<double> stiffness(grid, 0.3);
  std::vector<double> one(displacements.size()), three(displacements.size());
  ThreadPool alone(1), together(3);
  stiffness.apply(displacements, one, alone);
  stiffness.apply(displacements, three, together);
  EXPECT_EQ(one, three);
}

TEST(ElasticGrid, HasTheDiagonalOfItsStiffness) {
  ElasticGrid grid(dims, cell, random_moduli(7, 0.5));
  grid.hold(3, 1);
  const ElasticOperator<double> stiffness(grid, 0.3);
  const std::vector<double> inverse = stiffness.inverse_diagonal();
  ThreadPool pool(1);
  std::vector<double> unit(inverse.size(), 0.0), forces(inverse.size());
  for (const size_t i : {size_t{0}, size_t{11}, inverse.size() - 1}) {
    unit[i] = 1.0;
    stiffness.apply(unit, forces, pool);
    unit[i] = 0.0;
    EXPECT_NEAR(forces[i] * inverse[i], 1.0, 1e-5);
  }
  EXPECT_EQ(inverse[10], 0.0);
}

/// No motion of the coarse corners has more energy on the coarse grid than it may, and none less than half of
/// it.
TEST(ElasticGrid, ACoarseGridIsNeverMuchSofter) {
  const uint64_t seed = ream::test::seed(45);
  const BoxElement box(cell, 0.3);
  const ElasticGrid grid(dims, cell, random_moduli(seed, 0.3));
  const ElasticGrid coarse = grid.coarser(box.energy_shares());
  ThreadPool pool(1);
  for (uint64_t trial = 0; trial < 20; ++trial) {
    const std::vector<double> motion = random_displacements(coarse, seed + trial);
    std::vector<double> fine(3 * grid.corners(), 0.0), forces(fine.size()), coarse_forces(motion.size());
    for (size_t corner = 0; corner < grid.corners(); ++corner)
      for (int c = 0; c < 8; ++c) {
        const Vec3i place = grid.place_of(corner), low = place / 2, odd = place - 2 * low;
        const Vec3i step(c & 1, c >> 1 & 1, c >> 2);
        if ((step.array() > odd.array()).any()) continue;
        const auto near = static_cast<size_t>(coarse.corner_at(low + step));
        for (size_t k = 0; k < 3; ++k)
          fine[3 * corner + k] += std::pow(0.5, odd.sum()) * motion[3 * near + k];
      }
    ElasticOperator<double>(grid, 0.3).apply(fine, forces, pool);
    ElasticOperator<double>(coarse, 0.3).apply(motion, coarse_forces, pool);
    const double energy = std::inner_product(fine.begin(), fine.end(), forces.begin(), 0.0);
    const double of_coarse = std::inner_product(motion.begin(), motion.end(), coarse_forces.begin(), 0.0);
    EXPECT_LT(energy, 2.0 * of_coarse);
    EXPECT_GT(energy, 0.05 * of_coarse);
  }
}

TEST(ElasticGrid, IsCoarserByMeansOfItsCells) {
  std::vector<float> moduli(static_cast<size_t>(dims.prod()), 0.0f);
  for (int z = 0; z < 2; ++z)
    for (int y = 0; y < 2; ++y) moduli[static_cast<size_t>(dims.x() * (y + dims.y() * z))] = 80.0f;
  moduli.back() = 16.0f;
  ElasticGrid grid(dims, cell, moduli);
  for (size_t corner = 0; corner < grid.corners(); ++corner)
    if (grid.place_of(corner).z() == dims.z()) grid.hold(corner, 2);
  const std::array<float, 256> shares = BoxElement(cell, 0.3).energy_shares();
  const ElasticGrid coarse = grid.coarser(shares);
  EXPECT_EQ(coarse.dims(), Vec3i(3, 2, 4));
  EXPECT_EQ(coarse.cell_mm(), Vec3(2.0 * cell));
  ASSERT_EQ(coarse.elements(), 2u);
  // Four octants of eight, those at the lesser x; and the last cell's first one.
  EXPECT_FLOAT_EQ(coarse.moduli_mpa()[0], std::max(40.0f, 80.0f * shares[0b01010101] / 1.9f));
  EXPECT_FLOAT_EQ(coarse.moduli_mpa()[1], std::max(2.0f, 16.0f * shares[1] / 1.9f));
  for (size_t corner = 0; corner < coarse.corners(); ++corner)
    EXPECT_EQ(coarse.is_held(corner, 2), coarse.place_of(corner).z() == 4) << corner;
}

}  // namespace
}  // namespace ream::solve::test
