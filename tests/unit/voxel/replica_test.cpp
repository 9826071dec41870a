#include "voxel/replica.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/random_bone.hpp"

namespace ream::voxel {
namespace {

constexpr unsigned seed = 20269;

BrickImage image_of(uint32_t brick, uint8_t coverage) {
  BrickImage image;
  image.brick = brick;
  std::fill(std::begin(image.coverage), std::end(image.coverage), coverage);
  return image;
}

/// Blocks that hold a voxel at most two voxels from the brick, by looking at every block.
std::vector<uint32_t> blocks_near(const Replica& replica, uint32_t brick) {
  const Vec3i low = replica.grid().brick_coordinates(brick) * brick_edge - Vec3i::Constant(2);
  const Vec3i high = low + Vec3i::Constant(brick_edge - 1 + 4);
  std::vector<uint32_t> near;
  for (uint32_t block = 0; block < replica.block_count(); ++block) {
    const Vec3i first = replica.block_coordinates(block) * block_edge;
    const Vec3i last = first + Vec3i::Constant(block_edge - 1);
    if ((first.array() <= high.array()).all() && (last.array() >= low.array()).all()) near.push_back(block);
  }
  return near;
}

std::vector<uint32_t> sorted(std::vector<uint32_t> values) {
  std::sort(values.begin(), values.end());
  return values;
}

TEST(Replica, CoversTheGridWithBlocksAlsoWhereTheyDoNotFit) {
  std::mt19937 random(seed);
  const Replica replica(test::random_bone(random, {72, 32, 40}, 0.1));
  EXPECT_EQ(replica.block_dims(), Vec3i(3, 1, 2));
  EXPECT_EQ(replica.block_count(), 6u);
  EXPECT_EQ(replica.block_coordinates(5), Vec3i(2, 0, 1));
}

TEST(Replica, StartsAsACopyWithNothingDirty) {
  std::mt19937 random(seed);
  const BoneModel bone = test::random_bone(random, {40, 32, 32}, 0.5);
  Replica replica(bone);
  EXPECT_EQ(replica.coverage(), bone.coverage);
  EXPECT_TRUE(replica.take_dirty_blocks().empty());
}

TEST(Replica, EachBrickDirtiesExactlyTheBlocksWithinTwoVoxels) {
  Replica replica(make_bone(test::grid_of({72, 64, 40})));
  for (uint32_t brick = 0; brick < replica.grid().brick_count(); ++brick) {
    replica.apply(image_of(brick, 9));
    EXPECT_EQ(sorted(replica.take_dirty_blocks()), blocks_near(replica, brick)) << "brick " << brick;
  }
  EXPECT_TRUE(
      std::all_of(replica.coverage().begin(), replica.coverage().end(), [](uint8_t c) { return c == 9; }));
}

TEST(Replica, NamesADirtyBlockOnceInOrderOfFirstTouch) {
  Replica replica(make_bone(test::grid_of({96, 32, 32})));
  replica.apply(image_of(9, 1));  // x 72 to 79: inside block 2
  replica.apply(image_of(1, 1));  // x 8 to 15: inside block 0
  replica.apply(image_of(9, 2));
  EXPECT_EQ(replica.take_dirty_blocks(), (std::vector<uint32_t>{2, 0}));
  EXPECT_TRUE(replica.take_dirty_blocks().empty());
  replica.apply(image_of(4, 1));  // x 32 to 39: block 1 and, by its reach, block 0
  EXPECT_EQ(sorted(replica.take_dirty_blocks()), (std::vector<uint32_t>{0, 1}));
}

}  // namespace
}  // namespace ream::voxel
