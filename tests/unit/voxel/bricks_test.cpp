#include "voxel/bricks.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <thread>

#include "support/random_bone.hpp"
#include "support/seed.hpp"

namespace ream::voxel {
namespace {

constexpr uint32_t bricks_seed = 20268;

TEST(Bricks, ReadTheirVoxelsWithXFastest) {
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(bricks_seed));
  std::mt19937 random(test::seed(bricks_seed));
  const BoneModel bone = test::random_bone(random, {24, 16, 32}, 0.7);
  for (uint32_t b = 0; b < bone.grid.brick_count(); ++b) {
    uint8_t image[brick_voxels];
    read_brick(bone.grid, bone.coverage.data(), b, image);
    const Vec3i first = bone.grid.brick_coordinates(b) * brick_edge;
    for (int i = 0; i < brick_voxels; ++i)
      ASSERT_EQ(image[i], bone.coverage[bone.grid.index(first + Vec3i(i % 8, (i / 8) % 8, i / 64))]);
  }
}

TEST(Bricks, WritingWhatWasReadCopiesTheGridAndNothingElse) {
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(bricks_seed));
  std::mt19937 random(test::seed(bricks_seed));
  const BoneModel bone = test::random_bone(random, {24, 16, 32}, 0.7);
  std::vector<uint8_t> copy(bone.coverage.size(), 0);
  uint8_t image[brick_voxels];
  for (uint32_t b = 0; b < bone.grid.brick_count(); ++b) {
    read_brick(bone.grid, bone.coverage.data(), b, image);
    write_brick(bone.grid, copy.data(), b, image);
  }
  EXPECT_EQ(copy, bone.coverage);
  std::fill(std::begin(image), std::end(image), uint8_t{0});
  write_brick(bone.grid, copy.data(), 5, image);
  for (size_t i = 0; i < copy.size(); ++i) {
    const bool inside = bone.grid.brick_index(bone.grid.coordinates(i) / brick_edge) == 5;
    ASSERT_EQ(copy[i], inside ? 0 : bone.coverage[i]);
  }
}

TEST(BrickSender, SendsEachMarkedBrickOnceOldestFirstWithinItsBudget) {
  const BoneModel bone = make_bone(test::grid_of({32, 16, 8}));
  BrickRing ring(16);
  BrickSender sender(bone.grid, ring);
  for (const uint32_t brick : {6u, 2u, 6u, 7u, 2u, 0u}) sender.mark(brick);
  EXPECT_EQ(sender.pending(), 4u);
  sender.send(bone.coverage.data(), 11, 3);
  EXPECT_EQ(sender.pending(), 1u);
  sender.mark(6);  // changed again after it was sent: goes again, last
  sender.send(bone.coverage.data(), 12, 100);
  EXPECT_EQ(sender.pending(), 0u);
  std::vector<std::pair<uint32_t, uint32_t>> sent;
  for (BrickImage image; ring.try_pop(image);) sent.emplace_back(image.brick, image.tick);
  EXPECT_EQ(sent, (std::vector<std::pair<uint32_t, uint32_t>>{{6, 11}, {2, 11}, {7, 11}, {0, 12}, {6, 12}}));
}

TEST(BrickSender, KeepsWhatAFullRingRefusesAndSendsItsNewestImageLater) {
  BoneModel bone = make_bone(test::grid_of({32, 16, 8}));
  BrickRing ring(2);
  BrickSender sender(bone.grid, ring);
  for (uint32_t brick = 0; brick < 5; ++brick) sender.mark(brick);
  sender.send(bone.coverage.data(), 1, 100);
  EXPECT_EQ(sender.pending(), 3u);
  bone.coverage[bone.grid.brick_base(2)] = 77;
  BrickImage image;
  while (ring.try_pop(image)) {
  }
  sender.send(bone.coverage.data(), 2, 100);
  ASSERT_TRUE(ring.try_pop(image));
  EXPECT_EQ(image.brick, 2u);
  EXPECT_EQ(image.tick, 2u);
  EXPECT_EQ(image.coverage[0], 77);
}

TEST(BrickSender, LosesNothingWhenTheFollowerIsSlow) {
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(bricks_seed));
  std::mt19937 random(test::seed(bricks_seed));
  BoneModel bone = test::random_bone(random, {64, 32, 32}, 0.9);
  Replica replica(bone);
  BrickRing ring(4);
  std::atomic<bool> finished{false};
  std::atomic<uint64_t> received{0};
  std::thread follower([&] {
    BrickImage image;
    for (;;) {
      const bool was_finished = finished.load();
      if (ring.try_pop(image)) {
        replica.apply(image);
        received.fetch_add(1, std::memory_order_relaxed);
        if (image.brick % 3 == 0) std::this_thread::yield();
      } else if (was_finished) {
        return;
      } else {
        std::this_thread::yield();
      }
    }
  });

  BrickSender sender(bone.grid, ring);
  std::uniform_int_distribution<size_t> voxel(0, bone.coverage.size() - 1);
  uint32_t tick = 0;
  size_t most_pending = 0;
  for (; tick < 3000; ++tick) {
    for (int change = 0; change < 20; ++change) {
      const size_t i = voxel(random);
      bone.coverage[i] = static_cast<uint8_t>(bone.coverage[i] / 2);
      sender.mark(bone.grid.brick_index(bone.grid.coordinates(i) / brick_edge));
    }
    sender.send(bone.coverage.data(), tick, 8);
    most_pending = std::max(most_pending, sender.pending());
  }
  while (sender.pending() > 0) {
    sender.send(bone.coverage.data(), tick, 8);
    std::this_thread::yield();
  }
  finished.store(true);
  follower.join();
  EXPECT_GT(most_pending, ring.capacity()) << "the ring was never full: nothing was tested";
  EXPECT_LE(most_pending, bone.grid.brick_count());
  EXPECT_GT(received.load(), 0u);
  EXPECT_EQ(replica.coverage(), bone.coverage);
}

}  // namespace
}  // namespace ream::voxel
