#include <cstring>
#include <random>

#include "every_device.hpp"
#include "solve/conjugate_gradients.hpp"
#include "solve/multigrid.hpp"
#include "solve/multigrid_cl.hpp"
#include "solve/parallel_vectors.hpp"
#include "solve/rigid_aggregates_cl.hpp"
#include "solve/vectors_cl.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"

namespace ream::solve {
namespace {

constexpr double poisson = 0.3;

/// Cells at random of a few moduli, with holes, and degrees of freedom that are held here and there.
ElasticGrid random_grid(std::mt19937& random, const Vec3i& dims, double fill, double held = 0.1) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<float> moduli(static_cast<size_t>(dims.prod()));
  for (float& modulus : moduli)
    modulus = unit(random) < fill ? static_cast<float>(std::pow(10.0, 1.0 + 3.0 * unit(random))) : 0.0f;
  moduli.front() = 100.0f;
  ElasticGrid grid(dims, Vec3(0.3, 0.4, 0.25), moduli);
  for (size_t corner = 0; corner < grid.corners(); ++corner)
    for (int axis = 0; axis < 3; ++axis)
      if (unit(random) < held) grid.hold(corner, axis);
  return grid;
}

/// A bar that is held below and at the top, with holes that leave no part loose; large enough for three
/// levels.
ElasticGrid porous_bar(std::mt19937& random) {
  const Vec3i dims(13, 12, 21);
  std::vector<float> moduli;
  for (int i = 0; i < dims.prod(); ++i) {
    const Vec3i at(i % 13, i / 13 % 12, i / (13 * 12));
    const bool may_be_empty = at.x() % 2 == 1 && at.y() % 2 == 1 && at.z() % 2 == 1;
    moduli.push_back(may_be_empty && random() % 2 == 0 ? 0.0f : static_cast<float>(100 + random() % 10000));
  }
  ElasticGrid grid(dims, Vec3(0.3, 0.4, 0.25), moduli);
  for (size_t corner = 0; corner < grid.corners(); ++corner) {
    const int z = grid.place_of(corner).z();
    for (int axis = 0; axis < 3; ++axis)
      if (z == 0 || (z == dims.z() && axis == 2)) grid.hold(corner, axis);
  }
  return grid;
}

template <typename Real>
std::vector<Real> random_numbers(std::mt19937& random, size_t count, double scale) {
  std::uniform_real_distribution<double> number(-scale, scale);
  std::vector<Real> numbers(count);
  for (Real& value : numbers) value = random() % 8 == 0 ? Real{0} : static_cast<Real>(number(random));
  return numbers;
}

/// Numbers whose bits differ.
template <typename Real>
size_t different(const std::vector<Real>& a, const std::vector<Real>& b) {
  size_t count = a.size() == b.size() ? 0 : 1;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    count += std::memcmp(&a[i], &b[i], sizeof(Real)) != 0;
  return count;
}

template <typename Real>
std::vector<Real> read_all(const gpu::Queue& queue, const gpu::Buffer& buffer) {
  std::vector<Real> numbers(buffer.bytes() / sizeof(Real));
  buffer.read(queue, numbers.data(), buffer.bytes());
  return numbers;
}

template <typename Real>
gpu::Buffer put(const gpu::Queue& queue, const std::vector<Real>& numbers) {
  return gpu::Buffer::copy_of(queue, std::span(numbers));
}

template <typename Real>
void expect_the_same_forces(const gpu::Queue& queue, const gpu::Program& program, const ElasticGrid& grid,
                            std::mt19937& random) {
  ThreadPool pool(2);
  const ElasticOperator<Real> expected_of(grid, poisson);
  const ElasticGridCl on_device(queue, grid);
  ElasticOperatorCl<Real> stiffness(queue, program, on_device, expected_of);
  // The last two come near the ends of what floats can hold.
  for (const double scale : {1.0, 1e-3, 1e-38, 1e30}) {
    const auto displacements = random_numbers<Real>(random, 3 * grid.corners(), scale);
    std::vector<Real> forces(displacements.size());
    expected_of.apply(displacements, forces, pool);
    gpu::Buffer moved = put(queue, displacements), found = put(queue, displacements);
    stiffness.apply(moved, found);
    EXPECT_EQ(different(read_all<Real>(queue, found), forces), 0u) << "scale " << scale;
    auto left = random_numbers<Real>(random, displacements.size(), scale * 1e3);
    gpu::Buffer from = put(queue, left);
    stiffness.take_off(moved, from);
    for (size_t i = 0; i < left.size(); ++i) left[i] -= forces[i];
    EXPECT_EQ(different(read_all<Real>(queue, from), left), 0u) << "scale " << scale;
  }
}

TEST(ElasticOperatorCl, ForcesAreTheSameBits) {
  const uint32_t seed = test::seed();
  test::on_every_device([&](const gpu::Device& device) {
    const gpu::Queue queue(device);
    const gpu::Program singles = ElasticOperatorCl<float>::program(queue);
    std::mt19937 random(seed);
    std::vector<Vec3i> sizes{{1, 1, 1}, {9, 7, 1}, {1, 1, 12}, {1, 8, 3}, {6, 5, 7}, {17, 3, 9}};
    std::uniform_int_distribution<int> edge(1, 12);
    for (int i = 0; i < 6; ++i) sizes.push_back({edge(random), edge(random), edge(random)});
    for (const Vec3i& dims : sizes)
      for (const double fill : {0.15, 0.6, 1.0}) {
        SCOPED_TRACE(testing::Message() << dims.transpose() << ", filled " << fill);
        const ElasticGrid grid = random_grid(random, dims, fill);
        expect_the_same_forces<float>(queue, singles, grid, random);
        if (device.knows_doubles)
          expect_the_same_forces<double>(queue, ElasticOperatorCl<double>::program(queue), grid, random);
      }
  });
}

TEST(VectorsCl, SumsAndCombinationsAreTheSameBits) {
  const uint32_t seed = test::seed();
  ThreadPool pool(2);
  test::on_every_device([&](const gpu::Device& device) {
    if (!device.knows_doubles) return;
    const gpu::Queue queue(device);
    std::mt19937 random(seed);
    for (const size_t count : {1, 127, 128, 129, 4000, 32767, 32768, 32769, 100001}) {
      SCOPED_TRACE(count);
      VectorsCl vectors(queue, count);
      const auto x = random_numbers<double>(random, count, 1.0);
      auto y = random_numbers<double>(random, count, 1e5);
      const gpu::Buffer on_device = put(queue, x);
      gpu::Buffer other = put(queue, y), floats(queue, count * sizeof(float));
      const double sum = sum_of(pool, count, [&](size_t i) { return x[i] * y[i]; });
      EXPECT_EQ(vectors.dot(on_device, other), sum);
      vectors.combine(-0.3, on_device, 1.7, other);
      for (size_t i = 0; i < count; ++i) y[i] = -0.3 * x[i] + 1.7 * y[i];
      EXPECT_EQ(different(read_all<double>(queue, other), y), 0u);
      vectors.to_floats(1e-3, other, floats);
      vectors.to_doubles(7.0, floats, other);
      std::vector<float> singles(count);
      for (size_t i = 0; i < count; ++i) y[i] = 7.0 * double{singles[i] = static_cast<float>(1e-3 * y[i])};
      EXPECT_EQ(different(read_all<float>(queue, floats), singles), 0u);
      EXPECT_EQ(different(read_all<double>(queue, other), y), 0u);
    }
  });
}

TEST(MultigridCl, ACycleIsTheSameBitsAndLeavesGridsWhereTheyAre) {
  const uint32_t seed = test::seed();
  ThreadPool pool(2);
  std::mt19937 random(seed);
  const ElasticGrid grid = porous_bar(random);
  const auto residual = random_numbers<double>(random, 3 * grid.corners(), 10.0);
  std::vector<double> expected(residual.size()), again(residual.size());
  Multigrid multigrid(grid, poisson, pool);
  ASSERT_GE(multigrid.levels(), 3u);
  multigrid.cycle(residual, expected);
  test::on_every_device([&](const gpu::Device& device) {
    const gpu::Queue queue(device);
    MultigridCl on_device(queue, grid, poisson, pool);
    for (int time = 0; time < 2; ++time) {
      std::vector<double> correction(residual.size());
      on_device.cycle(residual, correction);
      EXPECT_EQ(different(correction, expected), 0u);
    }
    if (!device.knows_doubles) return;
    VectorsCl vectors(queue, residual.size());
    const gpu::Buffer forces = put(queue, residual);
    gpu::Buffer correction = vectors.zeros();
    const gpu::Traffic before = queue.traffic();
    on_device.cycle(forces, correction, vectors);
    // Fewer than 500 corners and one sum.
    EXPECT_LE(queue.traffic().bytes_to_device - before.bytes_to_device, 500 * 12u);
    EXPECT_LE(queue.traffic().bytes_from_device - before.bytes_from_device, 500 * 12u + 8u);
    EXPECT_EQ(different(read_all<double>(queue, correction), expected), 0u);
  });
}

TEST(RigidAggregatesCl, CorrectionsAreTheSameBits) {
  const uint32_t seed = test::seed();
  ThreadPool pool(2);
  std::mt19937 random(seed);
  const ElasticGrid grid = random_grid(random, {14, 9, 17}, 0.5);
  const RigidAggregates aggregates(grid, poisson);
  const auto residual = random_numbers<double>(random, 3 * grid.corners(), 10.0);
  const auto before = random_numbers<double>(random, residual.size(), 1e-3);
  std::vector<double> expected = before;
  aggregates.add_correction(residual, expected, pool);
  EXPECT_GT(different(before, expected), expected.size() / 2);
  test::on_every_device([&](const gpu::Device& device) {
    if (!device.knows_doubles) return;
    const gpu::Queue queue(device);
    const ElasticGridCl on_device(queue, grid);
    gpu::Buffer correction = put(queue, before);
    RigidAggregatesCl(queue, on_device, aggregates).add_correction(put(queue, residual), correction);
    EXPECT_EQ(different(read_all<double>(queue, correction), expected), 0u);
  });
}

class SolvedOnDevices : public testing::Test {
 protected:
  Solution solved(const gpu::Queue* queue) {
    SolverLimits limits;
    limits.tolerance = 1e-7;
    limits.queue = queue;
    return solve(grid_, poisson, guess_, limits, pool_, no_progress, loads_n_);
  }
  void expect_refused(const gpu::Device& device, const std::string& why) {
    const gpu::Queue queue(device);
    test::expect_error(ErrorKind::unavailable, why, [&] { solved(&queue); });
    test::expect_error(ErrorKind::unavailable, "--backend cpu", [&] { solved(&queue); });
  }

  std::mt19937 random_{test::seed()};
  ThreadPool pool_{2};
  const ElasticGrid grid_ = porous_bar(random_);
  std::vector<double> guess_ = random_numbers<double>(random_, 3 * grid_.corners(), 0.01), loads_n_;
};

TEST_F(SolvedOnDevices, DisplacementsAreTheSameBits) {
  for (const bool loaded : {false, true}) {
    if (loaded) loads_n_ = random_numbers<double>(random_, guess_.size(), 5.0);
    const Solution expected = solved(nullptr);
    EXPECT_TRUE(expected.converged);
    EXPECT_GT(expected.iterations, 5);
    test::on_every_device([&](gpu::Device device) {
      for (const bool with_doubles : {true, false}) {
        device.knows_doubles = device.knows_doubles && with_doubles;
        const gpu::Queue queue(device);
        const Solution found = solved(&queue);
        EXPECT_EQ(found.iterations, expected.iterations);
        EXPECT_EQ(found.relative_residual, expected.relative_residual);
        EXPECT_EQ(different(found.displacements_mm, expected.displacements_mm), 0u);
        EXPECT_GT(queue.traffic().launches, 20u * static_cast<unsigned>(found.iterations));
      }
    });
  }
}

TEST_F(SolvedOnDevices, WhatADeviceCannotDoIsSaid) {
  test::on_every_device([&](const gpu::Device& device) {
    gpu::Device small = device, flushing = device, narrow = device;
    small.memory_bytes = 1 << 19;
    expect_refused(small, " elements need 1 MiB of ");
    flushing.keeps_small_floats = false;
    expect_refused(flushing, "1e-38");
    narrow.max_buffer_bytes = 4096;
    expect_refused(narrow, "bytes is more than");
  });
}

}  // namespace
}  // namespace ream::solve
