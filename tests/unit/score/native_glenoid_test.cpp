#include "score/native_glenoid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "score/vault_clearance.hpp"
#include "support/analytic_glenoid.hpp"
#include "support/expect_error.hpp"

namespace ream::score {
namespace {

using test::AnalyticGlenoid;

Task task_on(const AnalyticGlenoid& glenoid, const std::string& reamer = "sphere 30,10") {
  Task task;
  task.anatomy.side = glenoid.shoulder.side;
  task.anatomy.landmarks = test::shoulder_landmarks(glenoid.shoulder);
  case_::Plan plan;
  plan.entry_mm = glenoid.mirrored(glenoid.frame().centre);
  plan.axis_direction = glenoid.mirrored(-glenoid.frame().n);
  plan.pilot_hole.reset();
  task.plan = plan;
  task.reamer = shell::make_tool(reamer).profile;
  return task;
}

TEST(NativeGlenoid, FindsTheFaceOfASphere) {
  const AnalyticGlenoid glenoid;
  const double voxel_mm = 0.3;
  const NativeGlenoid native(task_on(glenoid), test::bone_of(glenoid, voxel_mm));
  const test::GlenoidFormulas formulas(glenoid);
  size_t count = 0;
  for (size_t ray = 0; ray < native.rays().size(); ++ray) {
    if (!native.face()[ray]) continue;
    ++count;
    const Vec3 point = native.rays().world(ray, native.surface_mm()[ray]);
    ASSERT_NEAR(formulas.depth_mm(point), 0.0, 0.15 * voxel_mm);
    ASSERT_LT(formulas.beyond_wall_mm(point), 0.1);
    if (std::hypot(native.rays().x_mm(ray), native.rays().y_mm(ray)) < 5.0) {
      ASSERT_NEAR(native.exit_mm()[ray], glenoid.vault_mm, 0.3);
    }
  }
  const double area = 3.14159 * 0.25 * glenoid.shoulder.height_mm * glenoid.shoulder.width_mm;
  EXPECT_NEAR(static_cast<double>(count) * native.rays().cell_area_mm2(), area, 0.06 * area);
}

TEST(NativeGlenoid, FindsThePlateByDensity) {
  AnalyticGlenoid glenoid;
  for (const double plate_mm : {1.2, 1.9, 2.8}) {
    glenoid.plate_mm = plate_mm;
    const NativeGlenoid native(task_on(glenoid), test::bone_of(glenoid, 0.3));
    EXPECT_TRUE(native.plate().found_by_density);
    EXPECT_NEAR(native.plate().median_mm, plate_mm, 0.15) << plate_mm;
  }
  glenoid.compact_g_cc = glenoid.spongy_g_cc = 0.6;
  const NativeGlenoid even(task_on(glenoid), test::bone_of(glenoid, 0.3));
  EXPECT_FALSE(even.plate().found_by_density);
  EXPECT_EQ(even.plate().median_mm, 1.9);
}

TEST(NativeGlenoid, LeavesThePilotHoleOut) {
  const AnalyticGlenoid glenoid;
  Task task = task_on(glenoid);
  task.plan->pilot_hole = case_::PilotHole{6.0, 12.0};
  const NativeGlenoid native(task, test::bone_of(glenoid, 0.3));
  for (size_t ray = 0; ray < native.rays().size(); ++ray) {
    const double away = std::hypot(native.rays().x_mm(ray), native.rays().y_mm(ray));
    if (away < 3.3) {
      EXPECT_FALSE(native.face()[ray]);
    }
    if (away > 3.4 && away < 8.0) {
      EXPECT_TRUE(native.face()[ray]);
    }
  }
}

TEST(NativeGlenoid, TellsCartilageFromBone) {
  const AnalyticGlenoid glenoid;
  voxel::BoneModel bone = test::bone_of(glenoid, 0.3);
  const test::GlenoidFormulas formulas(glenoid);
  auto& density = bone.density.writable();
  for (size_t i = 0; i < density.size(); ++i) {
    const Vec3 p = bone.grid.world_from_grid.point(bone.grid.centre_mm(bone.grid.coordinates(i)));
    if (bone.coverage[i] != 0 && formulas.depth_mm(p) < 1.5) density[i] = voxel::cartilage_code;
  }
  const NativeGlenoid native(task_on(glenoid), bone);
  for (size_t ray = 0; ray < native.rays().size(); ++ray)
    if (native.face()[ray] && std::hypot(native.rays().x_mm(ray), native.rays().y_mm(ray)) < 5.0) {
      EXPECT_NEAR(native.subchondral_mm()[ray] - native.surface_mm()[ray], 1.5, 0.3);
    }
}

TEST(NativeGlenoid, ThinnedSaysTheSameOnFewerRays) {
  const AnalyticGlenoid glenoid;
  const NativeGlenoid native(task_on(glenoid), test::bone_of(glenoid, 0.3)), thin = native.thinned(4);
  EXPECT_NEAR(static_cast<double>(thin.rays().size()) * 16.0, static_cast<double>(native.rays().size()),
              0.03 * static_cast<double>(native.rays().size()));
  for (size_t ray = 0; ray < thin.rays().size(); ++ray) {
    const auto same =
        static_cast<size_t>(native.rays().nearest(thin.rays().x_mm(ray), thin.rays().y_mm(ray)));
    EXPECT_EQ(thin.surface_mm()[ray], native.surface_mm()[same]);
    EXPECT_EQ(thin.face()[ray], native.face()[same]);
    EXPECT_EQ(thin.plate().thickness_mm[ray], native.plate().thickness_mm[same]);
  }
}

TEST(NativeGlenoid, NeedsSomethingToMeasureAgainst) {
  const AnalyticGlenoid glenoid;
  Task task = task_on(glenoid);
  task.plan.reset();
  const voxel::BoneModel bone = test::bone_of(glenoid, 0.6);
  test::expect_error(ErrorKind::invalid_input, "plan", [&] { NativeGlenoid made(task, bone); });
  task.anatomy.glenoid = case_::glenoid_frame(*task.anatomy.landmarks, task.anatomy.side);
  EXPECT_GT(NativeGlenoid(task, bone).rays().size(), 0u);
}

/// A peg along the vault's axis: its distance from the wall by the vault's formula.
TEST(Vault, DistanceOfThePegsIsThatFromTheWall) {
  AnalyticGlenoid glenoid;
  glenoid.shoulder.height_mm = 36.0;
  glenoid.shoulder.width_mm = 30.0;
  glenoid.vault_mm = 24.0;
  const voxel::BoneModel bone = test::bone_of(glenoid, 0.3);
  Task task = task_on(glenoid);
  task.anatomy.glenoid = case_::glenoid_frame(*task.anatomy.landmarks, task.anatomy.side);
  const NativeGlenoid native(task, bone);
  const AchievedFace face = achieved_face(native, {bone.grid, bone.coverage.data()});
  CutLine line;
  MetricResults results;
  const Component component(native, face, line);
  measure_vault_clearance(native, component, line, results);
  // The tip of the central peg, 15 mm deep, is the nearest to the wall in front and behind.
  const test::GlenoidFormulas formulas(glenoid);
  double nearest = 1e9;
  for (double z = 2.0; z <= 15.0; z += 0.5)
    for (int i = 0; i < 64; ++i) {
      const double a = 2.0 * 3.14159265 * i / 64.0;
      for (const auto& [superior, radius, length] :
           {std::tuple{0.0, 3.5, 15.0}, {9.0, 2.25, 10.0}, {-9.0, 2.25, 10.0}})
        if (z <= length) {
          const AnalyticGlenoid::Frame f = glenoid.frame();
          const Vec3 apex = native.rays().world(component.apex_mm());
          const Vec3 p = apex + radius * std::cos(a) * f.anterior +
                         (superior + radius * std::sin(a)) * f.superior - z * f.n;
          nearest = std::min(nearest, -formulas.beyond_wall_mm(p));
        }
    }
  EXPECT_NEAR(*results.value("vault_distance_mm"), nearest, 0.35);
  EXPECT_EQ(*results.value("vault_breach_mm"), 0.0);
  EXPECT_GT(*results.value("vault_distance_tool_mm"), 5.0);
}

TEST(Vault, ABreachIsNegative) {
  AnalyticGlenoid glenoid;
  glenoid.shoulder.width_mm = 16.0;
  glenoid.vault_mm = 12.0;  // shorter than the central peg
  const voxel::BoneModel bone = test::bone_of(glenoid, 0.3);
  const NativeGlenoid native(task_on(glenoid, "sphere 30,7"), bone);
  const AchievedFace face = achieved_face(native, {bone.grid, bone.coverage.data()});
  MetricResults results;
  const CutLine line;
  measure_vault_clearance(native, Component(native, face, line), line, results);
  EXPECT_LT(*results.value("vault_distance_mm"), -2.0);
  EXPECT_EQ(*results.value("vault_breach_mm"), -*results.value("vault_distance_mm"));
}

}  // namespace
}  // namespace ream::score
