#include "voxel/bricks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/random_bone.hpp"
#include "support/seed.hpp"

namespace ream::voxel {
namespace {

TEST(Replica, StartsAsACopyAndTakesBricks) {
  std::mt19937 random(test::seed(20269));
  BoneModel bone = test::random_bone(random, {40, 32, 24}, 0.5);
  Replica replica(bone);
  EXPECT_EQ(replica.coverage(), bone.coverage);
  for (uint32_t brick = 0; brick < bone.grid.brick_count(); brick += 3) {
    BrickImage image;
    image.brick = brick;
    for (uint8_t& c : image.coverage) c = static_cast<uint8_t>(random() % 256);
    replica.apply(image);
    EXPECT_TRUE(std::equal(std::begin(image.coverage), std::end(image.coverage), replica.brick(brick)));
    write_brick(bone.grid, bone.coverage.data(), brick, image.coverage);
  }
  EXPECT_EQ(replica.coverage(), bone.coverage);
}

}  // namespace
}  // namespace ream::voxel
