#include "stream/mesh_publisher.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/seed.hpp"

namespace ream::stream {
namespace {

using voxel::BrickImage;

BrickImage image_of(uint32_t brick, uint8_t coverage) {
  BrickImage image;
  image.brick = brick;
  std::fill(std::begin(image.coverage), std::end(image.coverage), coverage);
  return image;
}

TEST(WaitingBricks, KeepTheNewestImageOfEachAndTheLargestChange) {
  const BrickImage shown = image_of(0, 200);
  WaitingBricks waiting;
  waiting.put(image_of(7, 200), shown.coverage, 10);
  EXPECT_TRUE(waiting.empty()) << "nothing changed";
  waiting.put(image_of(7, 190), shown.coverage, 20);
  waiting.put(image_of(3, 140), shown.coverage, 30);
  waiting.put(image_of(7, 180), shown.coverage, 40);
  ASSERT_EQ(waiting.images().size(), 2u);
  EXPECT_EQ(waiting.images()[0].brick, 7u);
  EXPECT_EQ(waiting.images()[0].coverage[100], 180);
  EXPECT_EQ(waiting.max_moved(), 60);
  EXPECT_EQ(waiting.since_ns(), 20);
  waiting.clear();
  EXPECT_TRUE(waiting.empty());
  EXPECT_EQ(waiting.max_moved(), 0);
  waiting.put(image_of(3, 199), shown.coverage, 50);
  EXPECT_EQ(waiting.since_ns(), 50);
}

TEST(WaitingBricks, TheBoxHoldsExactlyTheVoxelsThatDiffer) {
  std::mt19937 random(test::seed());
  for (int run = 0; run < 2000; ++run) {
    const BrickImage before = image_of(0, 100);
    BrickImage after = before;
    Vec3i low = Vec3i::Constant(8), high = Vec3i::Constant(-1);
    const unsigned changes = 1 + static_cast<unsigned>(random() % 4);
    for (unsigned i = 0; i < changes; ++i) {
      const auto voxel = static_cast<int>(random() % voxel::brick_voxels);
      after.coverage[voxel] = static_cast<uint8_t>(random() % 100);
      const Vec3i at(voxel % 8, voxel / 8 % 8, voxel / 64);
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
    }
    const VoxelBox box = difference_box(before.coverage, after.coverage);
    ASSERT_EQ(box.low, low);
    ASSERT_EQ(box.high, high);
  }
}

}  // namespace
}  // namespace ream::stream
