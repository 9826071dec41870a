#include "voxel/voxel_grid.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "support/expect_error.hpp"
#include "support/random_bone.hpp"
#include "support/seed.hpp"

namespace ream::voxel {
namespace {

using test::expect_error;
using test::grid_of;

TEST(VoxelGrid, IndexAndCoordinatesAreInverse) {
  const VoxelGrid grid = grid_of({16, 8, 24});
  size_t row = 0;
  std::vector<int> met(grid.voxel_count());
  for (int w = 0; w < 24; ++w)
    for (int v = 0; v < 8; ++v)
      for (int u = 0; u < 16; ++u, ++row) {
        ASSERT_EQ(grid.row_index(u, v, w), row) << "x runs fastest";
        const size_t index = grid.index(u, v, w);
        ASSERT_LT(index, met.size());
        ++met[index];
        ASSERT_EQ(grid.coordinates(index), Vec3i(u, v, w));
      }
  EXPECT_EQ(std::count(met.begin(), met.end(), 1), static_cast<long>(row));
}

TEST(VoxelGrid, KeepsBricksTogetherWithXFastest) {
  const VoxelGrid grid = grid_of({16, 8, 24});
  EXPECT_EQ(grid.index(1, 0, 0), 1u);
  EXPECT_EQ(grid.index(0, 1, 0), 8u);
  EXPECT_EQ(grid.index(0, 0, 1), 64u);
  EXPECT_EQ(grid.index(8, 0, 0), 512u) << "the next brick along x";
  EXPECT_EQ(grid.index(0, 0, 8), 2u * 512u) << "the next layer of bricks";
}

TEST(VoxelGrid, IndexesMoreThanFourThousandMillionVoxels) {
  const VoxelGrid grid = grid_of({2048, 2048, 2048});
  const Vec3i last(2047, 2046, 2045);
  EXPECT_EQ(grid.row_index(2047, 2046, 2045), 2047u + 2048u * (2046u + 2048ull * 2045u));
  EXPECT_EQ(grid.index(last), 512ull * (255 + 256 * (255 + 256 * 255)) + 7 + 8 * (6 + 8 * 5));
  EXPECT_EQ(grid.coordinates(grid.index(last)), last);
}

TEST(VoxelGrid, CentresLieInTheirVoxel) {
  const uint32_t seed = test::seed(20265);
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937 random(seed);
  const VoxelGrid grid = grid_of({16, 8, 24}, {0.3, 0.7, 1.1});
  std::uniform_real_distribution<double> within(-0.499, 0.499);
  for (size_t i = 0; i < grid.voxel_count(); ++i) {
    const Vec3i o = grid.coordinates(i);
    const Vec3 offset(within(random), within(random), within(random));
    ASSERT_EQ(grid.voxel_at(grid.centre_mm(o) + offset.cwiseProduct(grid.spacing_mm)), o);
  }
  EXPECT_EQ(grid.centre_mm({0, 0, 0}), Vec3(0.15, 0.35, 0.55));
  EXPECT_EQ(grid.voxel_at({-0.01, 0.0, 26.41}), Vec3i(-1, 0, 24));
  EXPECT_FALSE(grid.contains({-1, 0, 23}));
  EXPECT_FALSE(grid.contains({0, 0, 24}));
  EXPECT_TRUE(grid.contains({15, 7, 23}));
}

TEST(VoxelGrid, MeasuresItself) {
  const VoxelGrid grid = grid_of({16, 8, 24}, {0.5, 0.25, 2.0});
  EXPECT_EQ(grid.bounds_mm().max, Vec3(8, 2, 48));
  EXPECT_DOUBLE_EQ(grid.voxel_volume_mm3(), 0.25);
  EXPECT_DOUBLE_EQ(grid.min_spacing_mm(), 0.25);
}

TEST(VoxelGrid, BricksTileTheGrid) {
  const VoxelGrid grid = grid_of({16, 8, 24});
  EXPECT_EQ(grid.brick_count(), 6u);
  std::vector<int> covered(grid.voxel_count());
  for (uint32_t b = 0; b < grid.brick_count(); ++b) {
    EXPECT_EQ(grid.brick_index(grid.brick_coordinates(b)), b);
    const Vec3i first = grid.coordinates(grid.brick_base(b));
    for (int w = 0; w < brick_edge; ++w)
      for (int v = 0; v < brick_edge; ++v)
        for (int u = 0; u < brick_edge; ++u) ++covered[grid.index(first + Vec3i(u, v, w))];
  }
  EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), static_cast<long>(covered.size()));
}

TEST(WholeBricks, RoundsUp) {
  EXPECT_EQ(whole_bricks({1, 8, 9}), Vec3i(8, 8, 16));
  EXPECT_EQ(whole_bricks({0, 15, 16}), Vec3i(0, 16, 16));
}

TEST(ValidateGrid, RefusesGridsThatHoldNothingOrMakeNoSense) {
  EXPECT_NO_THROW(validate(grid_of({8, 16, 24})));
  for (const Vec3i& dims : {Vec3i(0, 8, 8), Vec3i(8, -8, 8), Vec3i(8, 8, 12)})
    expect_error(ErrorKind::invalid_input, std::to_string(dims.x()) + " x",
                 [&] { make_bone(grid_of(dims)); });
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -1.0, nan, infinite})
    expect_error(ErrorKind::invalid_input, "voxel size", [&] { validate(grid_of({8, 8, 8}, {1, bad, 1})); });
}

}  // namespace
}  // namespace ream::voxel
