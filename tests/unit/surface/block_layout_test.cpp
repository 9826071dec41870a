#include "surface/block_layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/seed.hpp"
#include "surface/block_mesh.hpp"
#include "unit/surface/volumes.hpp"

namespace ream::surface {
namespace {

TEST(BlockLayout, CoversTheGridWithBlocksAlsoWhereTheyDoNotFit) {
  const BlockLayout layout(grid_of({72, 32, 40}));
  EXPECT_EQ(layout.block_dims, Vec3i(3, 1, 2));
  EXPECT_EQ(layout.count(), 6u);
  EXPECT_EQ(layout.coordinates(5), Vec3i(2, 0, 1));
  for (uint32_t block = 0; block < layout.count(); ++block)
    EXPECT_EQ(layout.index(layout.coordinates(block)), block);
}

TEST(BlockLayout, AVoxelTouchesExactlyTheBlocksWithinTwoVoxels) {
  const BlockLayout layout(grid_of({72, 64, 40}));
  for (const Vec3i& voxel : {Vec3i(0, 0, 0), Vec3i(30, 29, 39), Vec3i(33, 34, 1), Vec3i(71, 63, 31)}) {
    std::set<uint32_t> touched, near;
    for_each_block(layout, blocks_touched(layout, voxel, voxel, 1), [&](uint32_t b) { touched.insert(b); });
    for (uint32_t block = 0; block < layout.count(); ++block) {
      const Vec3i first = layout.coordinates(block) * block_edge;
      if ((voxel.array() >= first.array() - 2).all() &&
          (voxel.array() <= first.array() + block_edge + 1).all())
        near.insert(block);
    }
    EXPECT_EQ(touched, near) << voxel.transpose();
  }
}

TEST(BlockLayout, NothingChangesOutsideTheTouchedBlocks) {
  std::mt19937 random(test::seed());
  const voxel::VoxelGrid grid = grid_of({96, 64, 64});
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int i = 0; i < 30; ++i) {
    std::vector<uint8_t> coverage = noise(grid, static_cast<unsigned>(random()));
    const Vec3i voxel(below(96), below(64), below(64));
    for (const int stride : {1, 2, 4}) {
      BlockExtractor extractor(grid, stride);
      const auto extract_all = [&] {
        std::vector<BlockMesh> meshes;
        for (uint32_t b = 0; b < extractor.layout().count(); ++b)
          meshes.push_back(extractor.extract(coverage.data(), b));
        return meshes;
      };
      const std::vector<BlockMesh> before = extract_all();
      coverage[grid.index(voxel)] ^= 0xff;
      const std::vector<BlockMesh> after = extract_all();
      std::set<uint32_t> touched;
      for_each_block(extractor.layout(), blocks_touched(extractor.layout(), voxel, voxel, stride),
                     [&](uint32_t b) { touched.insert(b); });
      for (uint32_t b = 0; b < before.size(); ++b)
        if (!touched.contains(b)) {
          EXPECT_TRUE(before[b].vertices == after[b].vertices && before[b].indices == after[b].indices)
              << voxel.transpose() << " stride " << stride << " block " << b;
        }
    }
  }
}

}  // namespace
}  // namespace ream::surface
