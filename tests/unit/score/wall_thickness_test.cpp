#include "score/wall_thickness.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "score/deviation.hpp"
#include "support/analytic_glenoid.hpp"
#include "surface/block_mesh.hpp"

namespace ream::score {
namespace {

constexpr double deeper_mm = 2.0;

constexpr double wall_voxel_mm = 0.3, shell_reach_mm = 9.0;

/// A face from which a shell of even thickness is gone within a radius of its middle: its normals are those
/// of the sphere that it was.
class WallOfShell : public testing::Test {
 protected:
  WallOfShell() : left_(bone_.coverage) {
    for (size_t i = 0; i < left_.size(); ++i) {
      const Vec3 p = bone_.grid.world_from_grid.point(bone_.grid.centre_mm(bone_.grid.coordinates(i)));
      if (aside_mm(p) > shell_reach_mm) continue;
      const double level = 127.5 + 255.0 * (formulas_.depth_mm(p) - deeper_mm) / wall_voxel_mm;
      left_[i] = std::min(left_[i], static_cast<uint8_t>(std::clamp(level, 0.0, 255.0)));
    }
  }

  double aside_mm(const Vec3& world) const {
    return (world - glenoid_.frame().centre).cross(glenoid_.frame().n).norm();
  }

  /// From the reamed face along its normal to where the formulas say that bone ends.
  double true_mm(const Vec3& on_face) const {
    const Vec3 normal = (on_face - formulas_.sphere_centre()).normalized();
    const Vec3 from = formulas_.sphere_centre() + (glenoid_.radius_mm + deeper_mm) * normal;
    double s = 0.01;
    while (formulas_.solid(from + s * normal)) s += 0.01;
    return s;
  }

  Task task() const {
    Task task;
    task.anatomy.side = glenoid_.shoulder.side;
    task.anatomy.landmarks = test::shoulder_landmarks(glenoid_.shoulder);
    task.plan = case_::Plan{};
    task.plan->entry_mm = glenoid_.frame().centre;
    task.plan->axis_direction = -glenoid_.frame().n;
    task.plan->pilot_hole.reset();
    task.reamer = shell::make_tool("sphere 38,9").profile;
    return task;
  }

  const test::AnalyticGlenoid glenoid_;
  const test::GlenoidFormulas formulas_{glenoid_};
  const voxel::BoneModel bone_ = test::bone_of(glenoid_, wall_voxel_mm);
  std::vector<uint8_t> left_;
  const NativeGlenoid native_{task(), bone_};
  const CoverageView coverage_{bone_.grid, left_.data()};
};

TEST_F(WallOfShell, IsThatOfTheFormulasAlongTheNormal) {
  const AchievedFace face = achieved_face(native_, coverage_);
  const auto thickness = wall_thickness_mm(native_, face, coverage_);
  size_t judged = 0;
  for (size_t ray = 0; ray < thickness.size(); ++ray) {
    const double aside = std::hypot(native_.rays().x_mm(ray), native_.rays().y_mm(ray));
    if (aside > shell_reach_mm + 0.5) {
      EXPECT_EQ(thickness[ray], no_surface_mm);
    }
    if (aside > shell_reach_mm - normal_over_mm - 0.5) continue;
    ++judged;
    EXPECT_NEAR(thickness[ray], true_mm(native_.rays().world(ray, face.surface_mm[ray])), 0.5 * wall_voxel_mm)
        << aside;
  }
  EXPECT_GT(judged, 1000u);
}

TEST_F(WallOfShell, ItsMapIsThatOfTheNearestPlaces) {
  const AchievedFace face = achieved_face(native_, coverage_);
  const auto thickness = wall_thickness_mm(native_, face, coverage_);
  const auto surface = surface::whole_surface(bone_.grid, left_.data());
  const auto codes = wall_codes(native_, thickness, face, bone_.grid, surface.vertices_mm);
  size_t known = 0;
  for (size_t i = 0; i < codes.size(); ++i) {
    const Vec3 at = bone_.grid.world_from_grid.point(surface.vertices_mm[i].cast<double>());
    if (codes[i] == deviation_unknown) continue;
    ++known;
    EXPECT_LT(aside_mm(at), shell_reach_mm + 0.5);
    if (aside_mm(at) < shell_reach_mm - normal_over_mm - 0.5) {
      // The nearest ray is up to 0.18 mm away, and where the wall slants thickness changes by 3 mm a mm.
      EXPECT_NEAR(codes[i] * wall_step_mm, true_mm(at), 0.5 * wall_step_mm + 0.18 * 3.0);
    }
  }
  EXPECT_GT(known, 1000u);
}

TEST_F(WallOfShell, LeastAndFifthPercentileAreOverWhatLiesUnderTheComponent) {
  const AchievedFace face = achieved_face(native_, coverage_);
  CutLine line;
  line.apex_mm = Vec3(0.0, 0.0, deeper_mm);
  const Component component(native_, face, line);
  MetricResults results;
  measure_wall_thickness(native_, face, coverage_, component, results);
  std::vector<double> all;
  for (size_t ray = 0; ray < native_.rays().size(); ++ray)
    if (std::hypot(native_.rays().x_mm(ray), native_.rays().y_mm(ray)) <
        component.outline_radius_mm() - thin_rim_mm + 1e-9)
      all.push_back(true_mm(native_.rays().world(ray, face.surface_mm[ray])));
  std::sort(all.begin(), all.end());
  EXPECT_NEAR(*results.value("wall_thickness_least_mm"), all.front(), 0.5 * wall_voxel_mm);
  EXPECT_NEAR(*results.value("wall_thickness_thin_mm"), all[all.size() / 20], 0.5 * wall_voxel_mm);
  measure_wall_thickness(native_, achieved_face(native_, {bone_.grid, bone_.coverage.data()}), coverage_,
                         component, results);
  EXPECT_FALSE(results.value("wall_thickness_least_mm")) << "nothing is reamed";
}

}  // namespace
}  // namespace ream::score
