#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "solve/conjugate_gradients.hpp"
#include "solve/elastic_operator.hpp"
#include "solve/multigrid.hpp"
#include "solve/rigid_aggregates.hpp"
#include "support/seed.hpp"

namespace ream::solve::test {
namespace {

using Doubles = std::vector<double>;

double dot(const Doubles& a, const Doubles& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Thin struts in a box: every sixth row of cells, and plates at both ends that hold them together.
ElasticGrid struts(const Vec3i& size) {
  std::vector<float> moduli;
  for (int z = 0; z < size.z(); ++z)
    for (int y = 0; y < size.y(); ++y)
      for (int x = 0; x < size.x(); ++x) {
        const bool end = z < 2 || z >= size.z() - 2;
        moduli.push_back(end || (x % 6 < 2 && y % 6 < 2) ? 10000.0f : 0.0f);
      }
  ElasticGrid grid(size, Vec3(0.05, 0.05, 0.05), moduli);
  for (size_t corner = 0; corner < grid.corners(); ++corner)
    if (grid.place_of(corner).z() == 0)
      for (int axis = 0; axis < 3; ++axis) grid.hold(corner, axis);
  return grid;
}

/// Forces that some motion takes.
Doubles balanced_forces(const ElasticGrid& grid, uint64_t seed, ThreadPool& pool) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  Doubles motion(3 * grid.corners()), forces(motion.size());
  for (size_t i = 0; i < motion.size(); ++i)
    motion[i] = grid.is_held(i / 3, static_cast<int>(i % 3)) ? 0.0 : number(random);
  ElasticOperator<double>(grid, 0.3).apply(motion, forces, pool);
  return forces;
}

class Preconditioner : public testing::Test {
 protected:
  const uint64_t seed_ = ream::test::seed(48);
  ThreadPool pool_{2};
  const ElasticGrid grid_ = struts({20, 20, 30});
};

TEST_F(Preconditioner, ACycleIsSymmetricAndNearlyTheInverse) {
  Multigrid multigrid(grid_, 0.3, pool_);
  EXPECT_GE(multigrid.levels(), 3u);
  const Doubles a = balanced_forces(grid_, seed_, pool_), b = balanced_forces(grid_, seed_ + 1, pool_);
  Doubles of_a(a.size()), of_b(a.size()), forces(a.size());
  multigrid.cycle(a, of_a);
  multigrid.cycle(b, of_b);
  EXPECT_NEAR(dot(a, of_b), dot(b, of_a), 1e-4 * std::sqrt(dot(a, of_a) * dot(b, of_b)));
  EXPECT_GT(dot(a, of_a), 0.0);
  ElasticOperator<double>(grid_, 0.3).apply(of_a, forces, pool_);
  EXPECT_NEAR(dot(of_a, forces) / dot(a, of_a), 1.0, 0.3);
}

/// The best of all motions of aggregates: the forces that are left do no work on any of them.
TEST_F(Preconditioner, AggregatesBalanceWhatTheyCan) {
  const RigidAggregates aggregates(grid_, 0.3);
  EXPECT_GT(aggregates.count(), 100u);
  const Doubles forces = balanced_forces(grid_, seed_, pool_);
  Doubles motion(forces.size(), 0.0), balanced(forces.size()), more(forces.size(), 0.0);
  aggregates.add_correction(forces, motion, pool_);
  ElasticOperator<double>(grid_, 0.3).apply(motion, balanced, pool_);
  EXPECT_NEAR(dot(motion, balanced), dot(forces, motion), 1e-6 * dot(forces, motion));
  Doubles left(forces.size());
  for (size_t i = 0; i < left.size(); ++i) left[i] = forces[i] - balanced[i];
  aggregates.add_correction(left, more, pool_);
  EXPECT_LT(dot(more, more), 1e-12 * dot(motion, motion));
  for (size_t i = 0; i < motion.size(); ++i)
    if (grid_.is_held(i / 3, static_cast<int>(i % 3))) {
      EXPECT_EQ(motion[i], 0.0);
    }
}

/// A few corners in a row have motions without any force.
TEST_F(Preconditioner, AggregatesMayBeLines) {
  std::vector<float> moduli(3 * 3 * 17, 0.0f);
  for (size_t z = 0; z < 17; ++z) moduli[9 * z] = 100.0f;
  ElasticGrid line({3, 3, 17}, Vec3::Ones(), moduli);
  line.hold(0, 2);
  const Doubles forces = balanced_forces(line, seed_, pool_);
  Doubles motion(forces.size(), 0.0);
  RigidAggregates(line, 0.3).add_correction(forces, motion, pool_);
  for (const double value : motion) EXPECT_TRUE(std::isfinite(value));
  EXPECT_GT(dot(forces, motion), 0.0);
}

TEST_F(Preconditioner, ThinStrutsNeedFewSteps) {
  Doubles guess(3 * grid_.corners(), 0.0);
  // The upper plate is pushed aside: struts bend.
  for (size_t corner = 0; corner < grid_.corners(); ++corner)
    if (!grid_.is_held(corner, 0) && grid_.place_of(corner).z() > 15) guess[3 * corner] = 0.1;
  ElasticGrid grid = grid_;
  for (size_t corner = 0; corner < grid.corners(); ++corner)
    if (grid.place_of(corner).z() == 30) grid.hold(corner, 0);
  const Solution solution = solve(grid, 0.3, guess, {1e-8, 100}, pool_);
  EXPECT_TRUE(solution.converged);
  EXPECT_LT(solution.iterations, 40);
  Doubles forces(guess.size());
  ElasticOperator<double>(grid, 0.3).apply(solution.displacements_mm, forces, pool_);
  Doubles first(guess.size());
  ElasticOperator<double>(grid, 0.3).apply(guess, first, pool_);
  EXPECT_LT(std::sqrt(dot(forces, forces)), 2e-8 * std::sqrt(dot(first, first)));
  for (size_t corner = 0; corner < grid.corners(); ++corner)
    if (grid.is_held(corner, 0)) {
      EXPECT_EQ(solution.displacements_mm[3 * corner], guess[3 * corner]);
    }
}

}  // namespace
}  // namespace ream::solve::test
