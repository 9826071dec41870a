#include "score/vault_clearance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>

#include "score/component_library.hpp"
#include "support/component_truth.hpp"

namespace ream::score {
namespace {

constexpr double voxel_mm = 0.4;

/// A vault by formulas, of any size, and a component of the library set on its face somewhere.
struct SetComponent {
  test::AnalyticGlenoid glenoid;
  Task task;
  CutLine line;

  explicit SetComponent(unsigned seed) {
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random() >> 8) / static_cast<double>(1u << 24);
    };
    glenoid.shoulder.side = seed % 2 == 0 ? case_::Side::right : case_::Side::left;
    glenoid.shoulder.version_deg = between(-15.0, 8.0);
    glenoid.shoulder.inclination_deg = between(-5.0, 12.0);
    glenoid.shoulder.height_mm = between(28.0, 38.0);
    glenoid.shoulder.width_mm = between(16.0, 27.0);
    glenoid.vault_mm = between(11.0, 19.0);
    const test::AnalyticGlenoid::Frame face = glenoid.frame();
    task.anatomy.side = glenoid.shoulder.side;
    task.anatomy.landmarks = test::shoulder_landmarks(glenoid.shoulder);
    task.anatomy.glenoid = case_::glenoid_frame(*task.anatomy.landmarks, task.anatomy.side);
    task.plan = case_::Plan{};
    task.plan->entry_mm = glenoid.mirrored(face.centre);
    task.plan->axis_direction = glenoid.mirrored(-face.n);
    task.plan->pilot_hole.reset();
    task.plan->implant_size = component_library()[seed % component_library().size()].name;
    task.reamer = shell::make_tool("sphere 34,9").profile;
    line.direction = Vec3(between(-0.2, 0.2), between(-0.2, 0.2), 1.0).normalized();
    line.apex_mm = Vec3(between(-1.5, 1.5), between(-1.5, 1.5), 0.0);
  }
};

TEST(VaultClearance, OfThePlansComponentIsThatOfTheFormulas) {
  double worst = 0.0;
  int breaches = 0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const SetComponent set(seed);
    const voxel::BoneModel bone = test::bone_of(set.glenoid, voxel_mm);
    const NativeGlenoid native(set.task, bone);
    const Component component(native, achieved_face(native, {bone.grid, bone.coverage.data()}), set.line);
    ASSERT_TRUE(component.seated());
    MetricResults results;
    measure_vault_clearance(native, component, set.line, results);
    const auto truth = test::vault_truth_mm(
        set.glenoid,
        {native.rays().world(component.apex_mm()), native.rays().world_direction(component.axis())},
        set.task.plan->implant_size);
    const double least = *std::min_element(truth.begin(), truth.end());
    const double said = *results.value("vault_distance_component_mm");
    EXPECT_NEAR(said, least, 0.5 * voxel_mm);
    EXPECT_EQ(*results.value("vault_breach_mm"), std::max(0.0, -said));
    worst = std::max(worst, std::abs(said - least));
    breaches += least < 0.0;
    const auto surely = [&](double beyond_mm) {
      return static_cast<double>(
          std::count_if(truth.begin(), truth.end(), [&](double mm) { return mm < -beyond_mm; }));
    };
    EXPECT_GE(*results.value("parts_through_vault"), surely(0.5 * voxel_mm));
    EXPECT_LE(*results.value("parts_through_vault"), surely(-0.5 * voxel_mm));
  }
  EXPECT_GT(breaches, 10) << "the seeds must try both";
  EXPECT_LT(breaches, 45);
  std::printf("worst: %.3f mm of voxels of %.1f mm; %d of 50 breach\n", worst, voxel_mm, breaches);
}

TEST(VaultClearance, WithoutANameItIsThatOfTheVirtualPegs) {
  SetComponent set(1);
  set.task.plan->implant_size = "of a maker";
  const voxel::BoneModel bone = test::bone_of(set.glenoid, 0.5);
  const NativeGlenoid native(set.task, bone);
  const Component component(native, achieved_face(native, {bone.grid, bone.coverage.data()}), set.line);
  MetricResults results;
  measure_vault_clearance(native, component, set.line, results);
  EXPECT_EQ(results.value("vault_distance_component_mm"), results.value("vault_distance_mm"));
  EXPECT_EQ(*results.value("vault_breach_mm"), std::max(0.0, -*results.value("vault_distance_mm")));
}

}  // namespace
}  // namespace ream::score
