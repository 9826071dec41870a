#include "ct/segment/mask.hpp"

#include <gtest/gtest.h>

namespace ream::ct {
namespace {

constexpr int edge = 8;
const Vec3i block_dims = Vec3i::Constant(edge);

size_t at(int u, int v, int w) { return static_cast<size_t>(u + edge * (v + edge * w)); }

Mask box(const Vec3i& low, const Vec3i& high) {
  Mask mask(edge * edge * edge);
  for (int w = low.z(); w < high.z(); ++w)
    for (int v = low.y(); v < high.y(); ++v)
      for (int u = low.x(); u < high.x(); ++u) mask[at(u, v, w)] = 1;
  return mask;
}

Mask both(const Mask& a, const Mask& b) {
  Mask result = a;
  for (size_t i = 0; i < a.size(); ++i) result[i] = a[i] | b[i];
  return result;
}

TEST(RegionGrowing, NeverLeaksThroughAnEdgeOrACorner) {
  const Mask one = box({0, 0, 0}, {4, 4, 4});
  for (const Vec3i& low : {Vec3i(4, 4, 0), Vec3i(4, 0, 4), Vec3i(0, 4, 4), Vec3i(4, 4, 4)}) {
    const Mask other = box(low, low + Vec3i::Constant(4));
    const Mask mask = both(one, other);
    EXPECT_EQ(grown_from(mask, block_dims, {1, 1, 1}), one);
    EXPECT_EQ(grown_from(mask, block_dims, low), other);
  }
}

TEST(RegionGrowing, CrossesAFaceAndKeepsInsideRows) {
  const Mask touching = both(box({0, 0, 0}, {4, 4, 4}), box({4, 3, 3}, {8, 8, 8}));
  EXPECT_EQ(grown_from(touching, block_dims, {0, 0, 0}), touching);
  // The last voxel of a row and the first of the next are neighbours in memory only.
  Mask wrap(edge * edge * edge);
  wrap[at(7, 0, 0)] = wrap[at(0, 1, 0)] = 1;
  EXPECT_EQ(count_set(grown_from(wrap, block_dims, {7, 0, 0})), 1u);
}

TEST(RegionGrowing, UnsetSeedGivesNothing) {
  EXPECT_EQ(count_set(grown_from(box({0, 0, 0}, {4, 4, 4}), block_dims, {6, 6, 6})), 0u);
}

TEST(LargestPart, IsTheOneWithMostVoxels) {
  const Mask small = box({0, 0, 0}, {2, 2, 2}), large = box({4, 4, 4}, {8, 8, 8});
  EXPECT_EQ(largest_part(both(small, large), block_dims), large);
  EXPECT_EQ(count_set(largest_part(Mask(small.size()), block_dims)), 0u);
}

TEST(FillVoids, ClosedVoidsOnly) {
  Mask shell = box({1, 1, 1}, {7, 7, 7});
  shell[at(3, 3, 3)] = shell[at(4, 3, 3)] = 0;
  Mask mask = shell;
  fill_voids(mask, block_dims);
  EXPECT_EQ(mask, box({1, 1, 1}, {7, 7, 7}));
  // A channel to the outside makes it a cavity of the outside.
  for (int u = 0; u < 4; ++u) shell[at(u, 3, 3)] = 0;
  mask = shell;
  fill_voids(mask, block_dims);
  EXPECT_EQ(mask, shell);
}

TEST(NearestSet, RespectsReachAndSpacing) {
  HuVolume volume;
  volume.dims = block_dims;
  volume.spacing_mm = {1, 1, 3};
  Mask mask(edge * edge * edge);
  mask[at(4, 4, 5)] = mask[at(6, 4, 4)] = 1;
  const Vec3 from = volume.world_of_centre({4, 4, 4});
  EXPECT_EQ(nearest_set(mask, volume, from, 5.0), Vec3i(6, 4, 4));
  EXPECT_FALSE(nearest_set(mask, volume, from, 1.5));
  EXPECT_EQ(nearest_set(mask, volume, volume.world_of_centre({4, 4, 5}), 0.0), Vec3i(4, 4, 5));
}

}  // namespace
}  // namespace ream::ct
