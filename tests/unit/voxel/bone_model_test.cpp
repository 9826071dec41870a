#include "voxel/bone_model.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "core/hash.hpp"
#include "support/random_bone.hpp"
#include "support/seed.hpp"

namespace ream::voxel {
namespace {

constexpr uint32_t bone_model_seed = 20266;

TEST(DensityCode, GoesThereAndBackForEveryCode) {
  for (int code = 0; code <= max_density_code; ++code)
    EXPECT_EQ(density_code(density_g_cc(static_cast<uint8_t>(code))), code);
}

TEST(DensityCode, IsTheNearestStepAndStaysInRange) {
  for (double density = 0.0; density <= 2.5; density += 0.0007)
    EXPECT_LE(std::abs(density_g_cc(density_code(density)) - density), 0.5 * density_step_g_cc + 1e-12);
  EXPECT_EQ(density_code(-3.0), 0);
  EXPECT_EQ(density_code(99.0), max_density_code);
  EXPECT_EQ(density_g_cc(cartilage_code), cartilage_density_g_cc);
}

TEST(ClassTable, SplitsBoneAtTheThresholdAndKnowsCartilage) {
  const auto table = class_table(1.0);
  for (int code = 0; code <= max_density_code; ++code)
    EXPECT_EQ(table[static_cast<size_t>(code)], code < 100 ? BoneClass::cancellous : BoneClass::cortical)
        << code;
  EXPECT_EQ(table[cartilage_code], BoneClass::cartilage);
}

TEST(BoneModel, FillsFromHalfCoverageUp) {
  BoneModel bone = make_bone(test::grid_of({8, 8, 8}));
  EXPECT_EQ(bone.filled_voxels(), 0u);
  bone.coverage[3] = 127;
  bone.coverage[4] = 128;
  bone.coverage[5] = 255;
  EXPECT_EQ(bone.filled_voxels(), 2u);
}

TEST(CoverageHash, DoesNotDependOnTheOrderOfChanges) {
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(bone_model_seed));
  std::mt19937 random(test::seed(bone_model_seed));
  BoneModel bone = test::random_bone(random, {16, 16, 16}, 0.5);
  const auto contribution = [](size_t i, uint8_t c) { return c == 0 ? uint64_t{0} : mix64(i * 256 + c); };
  uint64_t rolling = bone.coverage_hash();
  std::vector<size_t> order(bone.coverage.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::shuffle(order.begin(), order.end(), random);
  for (size_t k = 0; k < 1000; ++k) {
    const size_t i = order[k];
    const auto less = static_cast<uint8_t>(bone.coverage[i] / 2);
    rolling += contribution(i, less) - contribution(i, bone.coverage[i]);
    bone.coverage[i] = less;
  }
  EXPECT_EQ(rolling, bone.coverage_hash());
}

TEST(CoverageHash, TellsBonesApartThatDifferInOneVoxel) {
  SCOPED_TRACE(testing::Message() << "seed " << test::seed(bone_model_seed));
  std::mt19937 random(test::seed(bone_model_seed));
  BoneModel bone = test::random_bone(random, {8, 8, 8}, 0.5);
  const uint64_t before = bone.coverage_hash();
  for (size_t i = 0; i < bone.coverage.size(); ++i) {
    bone.coverage[i] ^= 1;
    EXPECT_NE(bone.coverage_hash(), before);
    bone.coverage[i] ^= 1;
  }
  EXPECT_EQ(bone.coverage_hash(), before);
  bone.density.writable()[0] ^= 1;
  EXPECT_EQ(bone.coverage_hash(), before) << "density never changes, so it is no part of it";
}

TEST(CoverageHash, OfAnEmptyBoneIsZero) {
  EXPECT_EQ(make_bone(test::grid_of({8, 8, 8})).coverage_hash(), 0u);
}

}  // namespace
}  // namespace ream::voxel
