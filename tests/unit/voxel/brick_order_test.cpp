#include "voxel/bricks.hpp"

#include <gtest/gtest.h>

#include "support/random_bone.hpp"
#include "support/seed.hpp"

namespace ream::voxel {
namespace {

TEST(BrickOrder, PutsEveryVoxelOfTheRowsWhereTheGridSaysAndBack) {
  const uint32_t seed = test::seed(20311);
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937 random(seed);
  const BoneModel bone = test::random_bone(random, {24, 8, 16}, 0.8);
  const std::vector<uint8_t> rows = rows_from_bricks(bone.grid, bone.coverage);
  for (int w = 0; w < 16; ++w)
    for (int v = 0; v < 8; ++v)
      for (int u = 0; u < 24; ++u)
        ASSERT_EQ(rows[bone.grid.row_index(u, v, w)], bone.coverage[bone.grid.index(u, v, w)]);
  EXPECT_EQ(bricks_from_rows(bone.grid, rows), bone.coverage);
}

}  // namespace
}  // namespace ream::voxel
