#include "case/two_plates.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "core/error.hpp"

namespace ream {
namespace {

constexpr double plate_z_mm = 19.3;

/// Density codes on the way down the middle of a plate, with how much of it each fills, mm.
std::vector<std::pair<int, double>> layers_along(const voxel::BoneModel& bone, double z_mm) {
  std::vector<std::pair<int, double>> layers;
  constexpr double step_mm = 0.02;
  for (double x = 5.0; x > -12.2; x -= step_mm) {
    const Vec3 p = bone.grid.world_from_grid.inverse().point(Vec3(x, 0.01, z_mm));
    if (voxel::coverage_at(bone, p) < 127.5) continue;
    const int code = bone.density[bone.grid.index(bone.grid.voxel_at(p))];
    if (layers.empty() || layers.back().first != code) layers.push_back({code, 0.0});
    layers.back().second += step_mm;
  }
  return layers;
}

/// As somebody counts them who holds the two plates: upper, lower.
std::map<std::string, std::vector<int>> codes_of(const std::string& comparison, bool asked_for_is_upper) {
  const case_::Case made = case_::make_two_plates(case_::two_plates_id(comparison, asked_for_is_upper));
  std::map<std::string, std::vector<int>> codes;
  for (const auto& [name, z] : {std::pair{"upper", plate_z_mm}, std::pair{"lower", -plate_z_mm}})
    for (const auto& [code, thickness] : layers_along(made.bone, z)) codes[name].push_back(code);
  return codes;
}

TEST(TwoPlates, EachComparisonHasTwoCasesWithNamesOfTheirOwnThatSayNothing) {
  std::set<std::string> ids;
  for (const case_::PlateComparison& comparison : case_::plate_comparisons())
    for (const bool upper : {true, false}) {
      const std::string id = case_::two_plates_id(comparison.id, upper);
      EXPECT_TRUE(case_::is_two_plates(id)) << id;
      EXPECT_EQ(id.find(comparison.id), std::string::npos) << id;
      EXPECT_TRUE(ids.insert(id).second) << id;
    }
  EXPECT_EQ(ids.size(), 2 * case_::plate_comparisons().size());
  EXPECT_THROW(case_::two_plates_id("unknown", true), Error);
  EXPECT_THROW(case_::make_two_plates("two-plates-00000000"), Error);
}

TEST(TwoPlates, WhatIsAskedForLiesWhereTheIdSays) {
  const int cartilage = 255;
  using Codes = std::map<std::string, std::vector<int>>;
  EXPECT_EQ(codes_of("cartilage", true), (Codes{{"upper", {cartilage, 145, 55}}, {"lower", {145, 55}}}));
  EXPECT_EQ(codes_of("cartilage", false), (Codes{{"upper", {145, 55}}, {"lower", {cartilage, 145, 55}}}));
  EXPECT_EQ(codes_of("bone_under_cartilage", false),
            (Codes{{"upper", {cartilage}}, {"lower", {cartilage, 145}}}));
  EXPECT_EQ(codes_of("through_plate", true), (Codes{{"upper", {130, 55}}, {"lower", {130}}}));
  EXPECT_EQ(codes_of("density", false), (Codes{{"upper", {45}}, {"lower", {65}}}));
}

TEST(TwoPlates, LayersAreAsThickAsTheyAreSaidToBe) {
  const double voxel_mm = 0.3;
  const case_::Case made = case_::make_two_plates(case_::two_plates_id("cartilage", true));
  const auto layers = layers_along(made.bone, plate_z_mm);
  ASSERT_EQ(layers.size(), 3U);
  EXPECT_NEAR(layers[0].second, 2.0, voxel_mm);
  EXPECT_NEAR(layers[1].second, 2.0, voxel_mm);
  // From the bottom of the hollow (0) to the bottom of the plate (-12).
  EXPECT_NEAR(layers[0].second + layers[1].second + layers[2].second, 12.0, 0.1);
}

TEST(TwoPlates, PlatesLookAlikeAndOneLikeAnotherCase) {
  const case_::Case made = case_::make_two_plates(case_::two_plates_id("cartilage", true));
  const voxel::VoxelGrid& grid = made.bone.grid;
  int worst = 0;
  for (int w = 0; w < grid.dims.z() / 2; ++w)
    for (int v = 0; v < grid.dims.y(); ++v)
      for (int u = 0; u < grid.dims.x(); ++u)
        worst = std::max(worst, std::abs(made.bone.coverage[grid.index(u, v, w)] -
                                         made.bone.coverage[grid.index(u, v, grid.dims.z() - 1 - w)]));
  EXPECT_LE(worst, 1);
  const case_::Case other = case_::make_two_plates(case_::two_plates_id("density", false));
  EXPECT_EQ(other.bone.coverage_hash(), made.bone.coverage_hash());
  EXPECT_EQ(other.name, made.name);
}

TEST(TwoPlates, OnlyTheHollowsTellThemApart) {
  std::vector<case_::Case> all;
  for (const case_::PlateComparison& comparison : case_::plate_comparisons())
    for (const bool upper : {true, false})
      all.push_back(case_::make_two_plates(case_::two_plates_id(comparison.id, upper)));
  const voxel::VoxelGrid& grid = all[0].bone.grid;
  size_t walls = 0;
  for (size_t i = 0; i < grid.voxel_count(); ++i) {
    if (all[0].bone.coverage[i] == 0) continue;
    const Vec3 p = grid.world_from_grid.point(grid.centre_mm(grid.coordinates(i)));
    const double from_upper = std::hypot(p.y(), p.z() - plate_z_mm);
    const double from_lower = std::hypot(p.y(), p.z() + plate_z_mm);
    if (std::min(from_upper, from_lower) < 18.7) continue;
    ++walls;
    for (const case_::Case& one : all) ASSERT_EQ(one.bone.density[i], 45) << p.transpose();
  }
  EXPECT_GT(walls, 10000u);
}

TEST(TwoPlates, ThePlanIsBetweenThemAndAirIsAllAround) {
  const case_::Case made = case_::make_two_plates(case_::two_plates_id("density", true));
  const auto met = case_::surface_along(made.bone, made.plan->entry_mm, made.plan->axis_direction);
  ASSERT_TRUE(met);
  EXPECT_LT((*met - made.plan->entry_mm).norm(), 0.05);
  const Vec3i dims = made.bone.grid.dims;
  for (int w = 0; w < dims.z(); ++w)
    for (int v = 0; v < dims.y(); ++v)
      for (int u = 0; u < dims.x(); ++u)
        if (u == 0 || v == 0 || w == 0 || u == dims.x() - 1 || v == dims.y() - 1 || w == dims.z() - 1) {
          ASSERT_EQ(made.bone.coverage[made.bone.grid.index(u, v, w)], 0) << u << " " << v << " " << w;
        }
}

}  // namespace
}  // namespace ream
