#include "score/alignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shell/parametric_profile.hpp"
#include "support/test_bone.hpp"

namespace ream::score {
namespace {

constexpr double surface_mm = 9.0, placement_voxel_mm = 0.2, depth_mm = 2.0;

/// A slab that is to be reamed straight down with a sphere of 9 mm, 6 mm wide.
class Placing : public testing::Test {
 protected:
  Placing() : bone_(test::slab(Vec3i(120, 120, 72), placement_voxel_mm, surface_mm, 1.0)) {
    task_.plan = test::slab_plan(bone_, surface_mm);
    task_.plan->depth_mm = depth_mm;
    task_.reamer = shell::parametric_profile("sphere 9,6");
    world_from_plan_ = {rotation_with_z_along(task_.plan->axis_direction), task_.plan->entry_mm};
  }

  /// What a sphere leaves whose apex is so deep at the middle.
  std::vector<uint8_t> reamed(double apex_depth_mm) const {
    std::vector<uint8_t> left = bone_.coverage;
    const Vec3 centre = task_.plan->entry_mm + Vec3(0, 0, 9.0 - apex_depth_mm);
    for (size_t i = 0; i < left.size(); ++i) {
      const Vec3 p = bone_.grid.centre_mm(bone_.grid.coordinates(i));
      if ((p - centre).head<2>().norm() > 6.0) continue;
      const double d = ((p - centre).norm() - 9.0) / placement_voxel_mm;
      left[i] = std::min(left[i], static_cast<uint8_t>(std::clamp(128.0 + 255.0 * d, 0.0, 255.0)));
    }
    return left;
  }

  Placements placements(const std::vector<uint8_t>& left, const std::optional<CutLine>& line) const {
    const NativeGlenoid native(task_, bone_);
    return placements_of(native, {bone_.grid, left.data()}, line, world_from_plan_);
  }

  voxel::BoneModel bone_;
  Task task_;
  Pose world_from_plan_;
};

TEST_F(Placing, ThePlannedReamerStandsAsDeepAsPlannedPastFirstContact) {
  const Placements p = placements(bone_.coverage, std::nullopt);
  ASSERT_TRUE(p.planned);
  EXPECT_LT((p.planned->apex_mm - (task_.plan->entry_mm - Vec3(0, 0, depth_mm))).norm(), 0.05);
  EXPECT_LT((p.planned->axis - Vec3(0, 0, -1)).norm(), 1e-9);
  EXPECT_FALSE(p.achieved);
  EXPECT_FALSE(p.implant) << "nothing was cut to seat it in";
}

TEST_F(Placing, TheImplantSitsInWhatWasReamed) {
  task_.plan->implant_radius_mm = 9.0;
  CutLine line;
  line.apex_mm = Vec3(0, 0, 1.5);
  line.deepest_mm = 1.6;
  const Placements p = placements(reamed(1.6), line);
  ASSERT_TRUE(p.achieved);
  EXPECT_LT((p.achieved->apex_mm - (task_.plan->entry_mm - Vec3(0, 0, 1.6))).norm(), 1e-6);
  ASSERT_TRUE(p.implant);
  EXPECT_LT((p.implant->apex_mm - (task_.plan->entry_mm - Vec3(0, 0, 1.6))).norm(), 0.5 * placement_voxel_mm);
  const Pose body = p.implant->world_from_body();
  EXPECT_LT((body.direction(Vec3::UnitZ()) - Vec3(0, 0, -1)).norm(), 1e-6);
}

TEST_F(Placing, TheImplantsBackIsItsSphereAsWideAsTheReamer) {
  EXPECT_NEAR(implant_back(task_, 4.0).distance_mm(Vec3(0, 0, 1.0)), 1.0, 1e-3) << "the reamer's own shape";
  task_.plan->implant_radius_mm = 30.0;
  const SweptFront back = implant_back(task_, 4.0);
  EXPECT_NEAR(back.outer_mm(), 6.0, 1e-6);
  const double r = 4.0, z = std::sqrt(900.0 - r * r) - 30.0;
  EXPECT_NEAR(back.distance_mm(Vec3(r, 0, z)), 0.0, 1e-3);
  task_.plan->implant_radius_mm = 5.0;
  EXPECT_NEAR(implant_back(task_, 4.0).outer_mm(), 5.0, 1e-6) << "a small sphere is no wider than itself";
}

}  // namespace
}  // namespace ream::score
