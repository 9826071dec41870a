#include <gtest/gtest.h>

#include "support/test_bone.hpp"

namespace ream::case_ {
namespace {

Case small_case() {
  Case c;
  c.id = "small";
  c.bone = test::slab({8, 16, 24}, 0.3, 2.0, 0.6);
  return c;
}

TEST(CaseHash, KnowsEverythingThatReamingDecidesBy) {
  const uint64_t hash = case_hash(small_case());
  EXPECT_EQ(case_hash(small_case()), hash);
  const auto expect_other = [&](const char* what, auto change) {
    Case c = small_case();
    change(c);
    EXPECT_NE(case_hash(c), hash) << what;
  };
  expect_other("a voxel's coverage", [](Case& c) { c.bone.coverage[5] ^= 1; });
  expect_other("the last voxel's coverage", [](Case& c) { c.bone.coverage.back() ^= 1; });
  expect_other("a voxel's density", [](Case& c) { c.bone.density.writable()[700] ^= 1; });
  expect_other("the threshold", [](Case& c) { c.bone.cortical_threshold_g_cc += 1e-9; });
  expect_other("a spacing", [](Case& c) { c.bone.grid.spacing_mm.y() += 1e-9; });
  expect_other("the place", [](Case& c) { c.bone.grid.world_from_grid.translation_mm.z() = 1e-9; });
  expect_other("two voxels swapped", [](Case& c) {
    c.bone.coverage[0] = 1;
    c.bone.coverage[1] = 2;
  });
}

TEST(CaseHash, DoesNotKnowWhatOnlyPeopleRead) {
  Case c = small_case();
  const uint64_t hash = case_hash(c);
  c.id = "other";
  c.name = "renamed";
  c.plan = test::slab_plan(c.bone, 2.0);
  c.warnings = {"dusty"};
  EXPECT_EQ(case_hash(c), hash);
}

}  // namespace
}  // namespace ream::case_
