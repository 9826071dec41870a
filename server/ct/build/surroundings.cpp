#include "ct/build/surroundings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>

#include "case/plan.hpp"
#include "geometry/mesh_io.hpp"

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

/// The mean of the triangles around each vertex, by their area.
std::vector<Vec3f> smooth_normals(const TriangleMesh& mesh) {
  std::vector<Vec3f> normals(mesh.vertices_mm.size(), Vec3f::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3f& corner = mesh.vertices_mm[a];
    const Vec3f twice_area = (mesh.vertices_mm[b] - corner).cross(mesh.vertices_mm[c] - corner);
    for (const uint32_t vertex : {a, b, c}) normals[vertex] += twice_area;
  }
  for (Vec3f& normal : normals) normal = normal.norm() > 0.0f ? Vec3f(normal.normalized()) : Vec3f::UnitZ();
  return normals;
}

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

TriangleMesh kept_surroundings(const std::filesystem::path& case_folder) {
  const std::filesystem::path file = case_folder / surroundings_file;
  if (!std::filesystem::exists(file)) return {};
  TriangleMesh around = load_mesh(file);
  around.normals = smooth_normals(around);
  return around;
}

}  // namespace ream::ct
