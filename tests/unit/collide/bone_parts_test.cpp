#include "collide/bone_buffers.hpp"

#include <gtest/gtest.h>

#include "support/expect_error.hpp"

namespace ream::collide {
namespace {

constexpr size_t gib = size_t{1} << 30;

TEST(BoneParts, ABoneThatFitsIsLeftWhole) {
  for (const size_t voxels : {size_t{512}, size_t{1000} * 512, 2 * gib}) {
    const BoneParts parts = bone_parts(voxels, voxels, "a device");
    EXPECT_EQ(parts.count, 1);
    EXPECT_EQ(parts.build_options(), " -D PARTS=1 -D PART_SHIFT=0");
  }
}

TEST(BoneParts, PartsAreWholeBricksWithinTheLimitAndHoldEveryVoxel) {
  struct Case {
    size_t voxels, limit;
    int count, built;
  };
  for (const auto& [voxels, limit, count, built] : {Case{gib + 512, gib, 2, 2},
                                                    {2 * gib - 512, gib + 12345, 2, 2},
                                                    {3 * gib / 2, gib / 2, 3, 4},
                                                    {2 * gib - 512, gib - 1, 4, 4},
                                                    {2048, 512, 4, 4},
                                                    {1024, 700, 2, 2}}) {
    SCOPED_TRACE(std::to_string(voxels) + " voxels, at most " + std::to_string(limit));
    const BoneParts parts = bone_parts(voxels, limit, "a device");
    const size_t part = size_t{1} << parts.shift, held = part * static_cast<size_t>(parts.count);
    EXPECT_EQ(parts.count, count);
    EXPECT_EQ(parts.built(), built);
    EXPECT_LE(part, limit);
    EXPECT_GT(2 * part, limit);
    EXPECT_EQ(part % 512, 0u);
    EXPECT_GE(held, voxels);
    EXPECT_LT(held - part, voxels);
  }
  EXPECT_EQ(bone_parts(gib + 512, gib, "a device").build_options(), " -D PARTS=2 -D PART_SHIFT=30");
}

TEST(BoneParts, WhatFourPartsDoNotHoldIsRefused) {
  const std::string message =
      "OpenCL: Small GPU allocates at most 300000 bytes at once, and the bone's 2097152 voxels do not fit in "
      "4 parts of 262144 bytes; use a coarser grid or --backend cpu";
  test::expect_error(ErrorKind::unavailable, message, [] { bone_parts(2097152, 300000, "Small GPU"); });
  EXPECT_NO_THROW(bone_parts(4 * 262144, 300000, "Small GPU"));
  for (const size_t limit : {size_t{0}, size_t{511}})
    test::expect_error(ErrorKind::unavailable, "--backend cpu", [&] { bone_parts(512, limit, "Tiny GPU"); });
}

}  // namespace
}  // namespace ream::collide
