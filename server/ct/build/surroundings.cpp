#include "ct/build/surroundings.hpp"

#include <algorithm>
#include <optional>

#include "case/plan.hpp"

namespace ream::ct {

namespace {

constexpr double overlap_mm = 1.0;
/// Wider than any reamer of the library, and deeper than any reaming.
constexpr double reamers_reach_mm = 24.0, reamers_depth_mm = 12.0;

/// Whether a place (world) is described by the grid alone.
class GridsOwn {
 public:
  explicit GridsOwn(const case_::Case& description)
      : grid_from_world_(description.bone.grid.world_from_grid.inverse()),
        box_(description.bone.grid.bounds_mm().grown(-overlap_mm)),
        plan_(description.plan) {}

  bool holds(const Vec3& world_mm) const { return in_box(world_mm) || in_reach(world_mm); }

 private:
  bool in_box(const Vec3& world_mm) const { return box_.contains(grid_from_world_.point(world_mm)); }
  bool in_reach(const Vec3& world_mm) const {
    if (!plan_) return false;
    const Vec3 axis = plan_->axis_direction.normalized(), from_entry = world_mm - plan_->entry_mm;
    const double along_mm = from_entry.dot(axis);
    return along_mm < reamers_depth_mm && (from_entry - along_mm * axis).norm() < reamers_reach_mm;
  }

  const Pose grid_from_world_;
  const Aabb box_;
  const std::optional<case_::Plan> plan_;
};

}  // namespace

TriangleMesh surroundings_of(const TriangleMesh& bone_world, const case_::Case& description) {
  const GridsOwn own(description);
  std::vector<uint8_t> inside(bone_world.vertices_mm.size());
  for (size_t i = 0; i < inside.size(); ++i) inside[i] = own.holds(bone_world.vertices_mm[i].cast<double>());
  constexpr uint32_t unused = UINT32_MAX;
  std::vector<uint32_t> place(inside.size(), unused);
  TriangleMesh around;
  for (std::array<uint32_t, 3> triangle : bone_world.triangles) {
    if (std::all_of(triangle.begin(), triangle.end(), [&](uint32_t corner) { return inside[corner]; }))
      continue;
    for (uint32_t& corner : triangle) {
      if (place[corner] == unused) {
        place[corner] = static_cast<uint32_t>(around.vertices_mm.size());
        around.vertices_mm.push_back(bone_world.vertices_mm[corner]);
        if (!bone_world.normals.empty()) around.normals.push_back(bone_world.normals[corner]);
      }
      corner = place[corner];
    }
    around.triangles.push_back(triangle);
  }
  return around;
}

}  // namespace ream::ct
