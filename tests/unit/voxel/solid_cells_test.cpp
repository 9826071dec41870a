#include "voxel/solid_cells.hpp"

#include <gtest/gtest.h>

#include "support/random_bone.hpp"
#include "support/seed.hpp"

namespace ream::voxel {
namespace {

constexpr uint32_t solid_cells_seed = 20312;

/// Half of the bricks whole, the others with random coverage.
BoneModel patchy_bone(std::mt19937& random) {
  BoneModel bone = test::random_bone(random, {32, 24, 16}, 0.9);
  for (uint32_t b = 0; b < bone.grid.brick_count(); ++b)
    if (random() % 2)
      for (size_t i = 0; i < brick_voxels; ++i) bone.coverage[bone.grid.brick_base(b) + i] = 255;
  return bone;
}

uint16_t expected_word(const BoneModel& bone, uint32_t brick) {
  const Vec3i first = bone.grid.brick_coordinates(brick) * brick_edge;
  int some[8] = {}, full[8] = {};
  for (int i = 0; i < brick_voxels; ++i) {
    const Vec3i in(i % 8, i / 8 % 8, i / 64);
    const int cell = in.x() / 4 + 2 * (in.y() / 4) + 4 * (in.z() / 4);
    const uint8_t coverage = bone.coverage[bone.grid.index(first + in)];
    some[cell] += coverage > 0;
    full[cell] += coverage == 255;
  }
  uint32_t word = 0;
  for (uint32_t k = 0; k < 8; ++k) word |= (some[k] > 0 ? 1u << k : 0u) | (full[k] == 64 ? 256u << k : 0u);
  return static_cast<uint16_t>(word);
}

TEST(SolidCells, SayOfEachCellWhetherAnyVoxelHasBoneAndAllAreFull) {
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(solid_cells_seed));
  std::mt19937 random(test::seed(solid_cells_seed));
  const BoneModel bone = patchy_bone(random);
  const SolidCells cells(bone);
  int whole = 0;
  for (uint32_t b = 0; b < bone.grid.brick_count(); ++b) {
    ASSERT_EQ(cells.word(b), expected_word(bone, b)) << "brick " << b;
    whole += cells.word(b) == 0xffff;
  }
  EXPECT_GT(whole, 5);
  EXPECT_EQ(cells.words().size(), bone.grid.brick_count() + 1);
}

TEST(SolidCells, TheBoxIsThatOfTheCellsWithBoneWhateverGoes) {
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(solid_cells_seed));
  std::mt19937 random(test::seed(solid_cells_seed));
  BoneModel bone = make_bone(test::grid_of({40, 24, 32}, {0.5, 0.25, 1.0}));
  for (int i = 0; i < 60; ++i)
    bone.coverage[random() % bone.coverage.size()] = static_cast<uint8_t>(1 + random() % 255);
  SolidCells cells(bone);
  for (;;) {
    Aabb box;
    std::vector<size_t> left;
    for (size_t i = 0; i < bone.coverage.size(); ++i) {
      if (bone.coverage[i] == 0) continue;
      left.push_back(i);
      const Vec3i cell = bone.grid.coordinates(i) / cell_edge;
      const Vec3 size = bone.grid.spacing_mm * cell_edge;
      box.include(cell.cast<double>().cwiseProduct(size));
      box.include((cell + Vec3i::Ones()).cast<double>().cwiseProduct(size));
    }
    const Aabb got = cells.bounds_mm();
    ASSERT_EQ(got.empty(), left.empty());
    if (left.empty()) break;
    ASSERT_EQ(got.min, box.min) << left.size() << " voxels left";
    ASSERT_EQ(got.max, box.max) << left.size() << " voxels left";
    const size_t gone = left[random() % left.size()];
    bone.coverage[gone] = 0;
    const auto brick = static_cast<uint32_t>(gone / brick_voxels);
    cells.set(brick, SolidCells::word_of(bone.coverage.data() + bone.grid.brick_base(brick)));
  }
}

}  // namespace
}  // namespace ream::voxel
