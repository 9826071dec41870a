#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "solve/bone_compression.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"
#include "unit/fe/small_models.hpp"

namespace ream::solve::test {
namespace {

using fe::test::model_of;

CompressionRequest along(int axis, double poisson = 0.3) {
  CompressionRequest request;
  request.rule.poisson = poisson;
  request.compression.axis = axis;
  request.limits.tolerance = 1e-10;
  return request;
}

CompressionResult solved(fe::ElementModel model, const CompressionRequest& request) {
  MemoryBudget budget;
  CompressionResult result = compress(std::move(model), request, budget);
  EXPECT_TRUE(result.converged) << result.relative_residual;
  return result;
}

TEST(Compression, ACubeHasTheModulusItWasGiven) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto cube = [](int, int, int) { return 1000; };
    const CompressionResult r = solved(model_of({9, 7, 12}, cube, 0.5), along(axis));
    EXPECT_NEAR(r.modulus_mpa, 1000.0, 1e-5);
    const double area_mm2 = r.box_mm.prod() / r.box_mm[axis];
    EXPECT_NEAR(r.force_n, 10.0 * area_mm2, 1e-5);
    EXPECT_NEAR(r.effective_strain[0], 0.01, 1e-7);
    EXPECT_NEAR(r.effective_strain[3], 0.01, 1e-7);
    EXPECT_LT(r.unbalanced, 1e-8);
    EXPECT_NEAR(r.voigt_mpa, 1000.0, 1e-9);
    EXPECT_NEAR(r.reuss_mpa, 1000.0, 1e-9);
  }
}

TEST(Compression, LayersInSeriesAreReussAndInParallelVoigt) {
  const auto layered = [](int axis) {
    return model_of({8, 8, 8}, [=](int u, int v, int w) {
      return (axis == 0 ? u : axis == 1 ? v : w) % 2 == 0 ? 18000 : 500;
    });
  };
  const double reuss = 2.0 / (1.0 / 18000 + 1.0 / 500), voigt = (18000.0 + 500.0) / 2;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(solved(layered(axis), along(axis, 0.0)).modulus_mpa, reuss, 1e-6 * reuss);
    EXPECT_NEAR(solved(layered((axis + 1) % 3), along(axis, 0.0)).modulus_mpa, voigt, 1e-6 * voigt);
  }
}

TEST(Compression, IsBetweenItsBounds) {
  const uint64_t seed = ream::test::seed(44);
  for (const double fill : {0.5, 0.7, 1.0}) {
    const fe::test::RandomGray gray({14, 11, 13}, fill, seed);
    const CompressionResult r = solved(model_of({14, 11, 13}, gray), along(2));
    EXPECT_LT(r.modulus_mpa, r.voigt_mpa * (1.0 + 1e-9));
    EXPECT_GT(r.modulus_mpa, r.reuss_mpa);
    EXPECT_EQ(r.reuss_mpa > 0.0, fill == 1.0);
    EXPECT_LT(r.unbalanced, 1e-7);
    EXPECT_NEAR(r.bone_share, fill, 0.08);
  }
}

TEST(Compression, HeldAcrossItIsStiffer) {
  const auto cube = [](int, int, int) { return 1000; };
  CompressionRequest request = along(2);
  request.compression.fixed_platens = true;
  const CompressionResult r = solved(model_of({6, 6, 6}, cube), request);
  EXPECT_GT(r.modulus_mpa, 1001.0);
  // Never as stiff as a body that cannot move sideways at all: E (1 - nu) / ((1 + nu)(1 - 2 nu)).
  EXPECT_NEAR(r.voigt_mpa, 1346.2, 0.1);
  EXPECT_LT(r.modulus_mpa, r.voigt_mpa);
}

TEST(Compression, TheSameOnAnyNumberOfThreads) {
  const fe::test::RandomGray gray({20, 20, 20}, 0.7, 9);
  CompressionRequest request = along(0);
  request.threads = 1;
  const CompressionResult one = solved(model_of({20, 20, 20}, gray), request);
  request.threads = 3;
  const CompressionResult three = solved(model_of({20, 20, 20}, gray), request);
  EXPECT_EQ(one.force_n, three.force_n);
  EXPECT_EQ(one.effective_strain, three.effective_strain);
  EXPECT_EQ(one.iterations, three.iterations);
}

TEST(Compression, AFewElementsAreSolvedToo) {
  const auto some = [](int u, int, int) { return u == 0 ? 100 : -1; };
  EXPECT_NEAR(solved(model_of({1, 1, 1}, some), along(2)).modulus_mpa, 100.0, 1e-6);
  // A column of one voxel, and empty room beside it that does not count.
  EXPECT_NEAR(solved(model_of({3, 1, 40}, some), along(2)).modulus_mpa, 100.0, 1e-5);
}

TEST(Compression, TakesIslandsOutUnlessTheyAreToStay) {
  const auto two = [](int u, int, int w) { return u < 2 || (u == 4 && w == 2) ? 100 : -1; };
  const CompressionResult r = solved(model_of({5, 2, 5}, two), along(2));
  EXPECT_EQ(r.components.removed_voxels, 2u);
  EXPECT_EQ(r.elements, 20u);
  EXPECT_NEAR(r.modulus_mpa, 100.0, 1e-6);
}

TEST(Compression, LeavesOutWhatCarriesNothing) {
  const auto two = [](int u, int, int w) { return u < 2 || (u == 4 && w == 2) ? 100 : -1; };
  CompressionRequest request = along(2);
  request.keep_islands = true;
  const CompressionResult r = solved(model_of({5, 2, 5}, two), request);
  EXPECT_EQ(r.unloaded_elements, 2u);
  EXPECT_EQ(r.elements, 20u);
  EXPECT_NEAR(r.bone_share, 0.44, 1e-9);
  EXPECT_NEAR(r.modulus_mpa, 40.0, 1e-6);  // of the box, of which it fills two fifths
  // Many of them, too, and a part that hangs on one platen only.
  const auto dust = [](int u, int v, int w) {
    const bool column = u < 2 && v < 2, lone = u % 2 == 0 && v % 2 == 0 && w % 2 == 0 && u > 3;
    return column || lone || (u == 3 && w < 10) ? 100 : -1;
  };
  const CompressionResult with_dust = solved(model_of({40, 30, 20}, dust), request);
  EXPECT_EQ(with_dust.elements, 80u);
  EXPECT_GT(with_dust.unloaded_elements, 2700u);
}

/// In layers one after the other the softer takes more, so that both carry the same.
TEST(Compression, TellsWhatEachElementTakes) {
  const auto layered = [](int, int, int w) { return w % 2 == 0 ? 1000 : 500; };
  const CompressionResult r = solved(model_of({6, 6, 8}, layered), along(2, 0.0));
  EXPECT_NEAR(r.effective_strain[0], 0.02 / 3, 1e-8);
  for (const size_t i : {1u, 2u, 3u}) EXPECT_NEAR(r.effective_strain[i], 0.04 / 3, 1e-8);
  const fe::test::RandomGray gray({9, 8, 10}, 1.0, ream::test::seed(49));
  const CompressionResult mixed = solved(model_of({9, 8, 10}, gray), along(1));
  EXPECT_LT(mixed.effective_strain[0], mixed.effective_strain[1]);
  EXPECT_LT(mixed.effective_strain[2], mixed.effective_strain[3]);
  EXPECT_NEAR(mixed.effective_strain[0], 0.01, 0.001);
}

TEST(Compression, SaysThatItHasNotConverged) {
  const fe::test::RandomGray gray({16, 16, 16}, 0.5, 3);
  CompressionRequest request = along(2);
  request.limits.max_iterations = 2;
  MemoryBudget budget;
  const CompressionResult r = compress(model_of({16, 16, 16}, gray), request, budget);
  EXPECT_FALSE(r.converged);
  EXPECT_EQ(r.iterations, 2);
  EXPECT_GT(r.relative_residual, 1e-10);
  EXPECT_EQ(to_json(r).at("converged"), false);
  EXPECT_GT(r.unbalanced, 1e-3);
}

TEST(Compression, WhatIsNoTestIsRefused) {
  MemoryBudget budget;
  const auto none = [](int, int, int) { return -1; };
  ream::test::expect_error(ErrorKind::invalid_input, "no voxel is bone", [&] {
    compress(model_of({2, 2, 2}, none), along(2), budget);
  });
  const auto all = [](int, int, int) { return 100; };
  CompressionRequest request = along(2);
  request.compression.strain = 0.0;
  ream::test::expect_error(ErrorKind::usage, "strain", [&] {
    compress(model_of({2, 2, 2}, all), request, budget);
  });
  const auto gap = [](int, int, int w) { return w < 2 || w > 3 ? 100 : -1; };
  request = along(2);
  request.keep_islands = true;
  ream::test::expect_error(ErrorKind::invalid_input, "reaches both platens", [&] {
    compress(model_of({3, 3, 6}, gap), request, budget);
  });
  for (const double factor : {1e-60, 1e39}) {
    request.rule.law = fe::linear_law(0.0, factor);
    ream::test::expect_error(ErrorKind::invalid_input, "a modulus is", [&] {
      compress(model_of({2, 2, 2}, all), request, budget);
    });
  }
  ream::test::expect_error(ErrorKind::usage, "0.49", [&] {
    compress(model_of({2, 2, 2}, all), along(2, 0.495), budget);
  });
  ream::test::expect_error(ErrorKind::usage, "Poisson", [&] {
    compress(model_of({2, 2, 2}, all), along(2, -1.0), budget);
  });
}

}  // namespace
}  // namespace ream::solve::test
