// The implant's map speaks of the face alone, as seating does.
#include <gtest/gtest.h>

#include "score/deviation.hpp"
#include "support/analytic_glenoid.hpp"
#include "surface/block_mesh.hpp"

namespace ream::score {
namespace {

TEST(FaceMap, LeavesOutWallsAndBack) {
  const test::AnalyticGlenoid glenoid;
  const test::GlenoidFormulas formulas(glenoid);
  const voxel::BoneModel bone = test::bone_of(glenoid, 0.5);
  Task task;
  task.anatomy.landmarks = test::shoulder_landmarks(glenoid.shoulder);
  task.anatomy.glenoid = case_::glenoid_frame(*task.anatomy.landmarks, task.anatomy.side);
  case_::Plan plan;
  plan.entry_mm = glenoid.frame().centre;
  plan.axis_direction = -glenoid.frame().n;
  task.plan = plan;
  task.reamer = shell::make_tool("sphere 30,11").profile;
  const NativeGlenoid native(task, bone);
  const auto surface = surface::whole_surface(bone.grid, bone.coverage.data());
  std::vector<int8_t> codes(surface.vertices_mm.size(), 5);
  keep_face_only(native, achieved_face(native, {bone.grid, bone.coverage.data()}), bone.grid,
                 surface.vertices_mm, codes);
  size_t kept = 0, inner_face = 0, inner_kept = 0;
  for (size_t i = 0; i < codes.size(); ++i) {
    const Vec3 at = bone.grid.world_from_grid.point(surface.vertices_mm[i].cast<double>());
    const bool known = codes[i] != deviation_unknown;
    EXPECT_TRUE(!known || codes[i] == 5);
    if (known) {
      ++kept;
      EXPECT_NEAR(formulas.depth_mm(at), 0.0, 1.0) << "on the face, or where it ends at the wall";
    }
    // A voxel and more inside the rim, and beside the pilot hole, the face is there.
    const double aside = (at - plan.entry_mm).cross(plan.axis_direction).norm();
    if (std::abs(formulas.depth_mm(at)) > 0.3 || formulas.beyond_wall_mm(at) > -1.5 || aside < 5.0) continue;
    ++inner_face;
    inner_kept += known;
  }
  EXPECT_GT(kept, 500u);
  EXPECT_EQ(inner_kept, inner_face);
}

}  // namespace
}  // namespace ream::score
