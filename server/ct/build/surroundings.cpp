#include "ct/build/surroundings.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/error.hpp"
#include "core/log.hpp"
#include "geometry/mesh_io.hpp"
#include "surface/block_mesh.hpp"

namespace ream::ct {
namespace {

constexpr double overlap_mm = 1.0;
// The grid's own surface is closed along its sides, with a rim that faces their way: what lies around covers
// it.
constexpr double cover_mm = 0.25, cover_reach_mm = 2.0;
/// Wider than any reamer of the library, and deeper than any reaming; web/src/scene/surroundings_view.ts has
/// them, too.
constexpr double reamers_reach_mm = 24.0, reamers_depth_mm = 12.0;
constexpr double max_fine_voxels = 4.0e6;  // beyond, a CT is sampled every other voxel

/// The mesh without triangles whose corners are all left out, and without corners of no triangle.
template <typename LeftOut>
TriangleMesh without(const TriangleMesh& mesh, LeftOut&& left_out) {
  std::vector<uint8_t> out(mesh.vertices_mm.size());
  for (size_t i = 0; i < out.size(); ++i) out[i] = left_out(mesh.vertices_mm[i].cast<double>());
  constexpr uint32_t unused = UINT32_MAX;
  std::vector<uint32_t> place(out.size(), unused);
  TriangleMesh rest;
  for (std::array<uint32_t, 3> triangle : mesh.triangles) {
    if (std::all_of(triangle.begin(), triangle.end(), [&](uint32_t corner) { return out[corner]; })) continue;
    for (uint32_t& corner : triangle) {
      if (place[corner] == unused) {
        place[corner] = static_cast<uint32_t>(rest.vertices_mm.size());
        rest.vertices_mm.push_back(mesh.vertices_mm[corner]);
        if (!mesh.normals.empty()) rest.normals.push_back(mesh.normals[corner]);
      }
      corner = place[corner];
    }
    rest.triangles.push_back(triangle);
  }
  return rest;
}

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

/// How far a point lies from the nearest side of a box, in it or beside it.
double distance_to_side(const Aabb& box, const Vec3& p) {
  const Vec3 beyond = (box.min - p).cwiseMax(p - box.max);
  return beyond.maxCoeff() > 0.0 ? beyond.cwiseMax(0.0).norm() : -beyond.maxCoeff();
}

}  // namespace

TriangleMesh surroundings_of(const TriangleMesh& bone_world, const voxel::VoxelGrid& grid) {
  const Pose grid_from_world = grid.world_from_grid.inverse();
  const Aabb sides = grid.bounds_mm(), box = sides.grown(-overlap_mm);
  TriangleMesh rest = without(
      bone_world, [&](const Vec3& world_mm) { return box.contains(grid_from_world.point(world_mm)); });
  const std::vector<Vec3f> normals = smooth_normals(rest);
  for (size_t i = 0; i < normals.size(); ++i) {
    Vec3f& vertex = rest.vertices_mm[i];
    const double from_side = distance_to_side(sides, grid_from_world.point(vertex.cast<double>()));
    const double cover = cover_mm * std::max(0.0, 1.0 - from_side / cover_reach_mm);
    vertex += static_cast<float>(cover) * normals[i];
  }
  return rest;
}

TriangleMesh scapula_around(const Workup& workup, const std::vector<int16_t>& hu,
                            const std::vector<uint8_t>& labels, const voxel::VoxelGrid& grid) {
  const voxel::BoneModel scapula = scapula_of(workup, hu, labels);
  const bool coarse = static_cast<double>(scapula.grid.voxel_count()) > max_fine_voxels;
  const TriangleMesh surface =
      surface::whole_surface(scapula.grid, scapula.coverage.data(), 1, coarse ? 2 : 1);
  return surroundings_of(surface.transformed(scapula.grid.world_from_grid), grid);
}

TriangleMesh beyond_reach(const TriangleMesh& around, const case_::Plan& plan, const voxel::VoxelGrid& grid) {
  const Vec3 axis = plan.axis_direction.normalized();
  const Pose grid_from_world = grid.world_from_grid.inverse();
  const Aabb box = grid.bounds_mm();
  return without(around, [&](const Vec3& world_mm) {
    if (!box.contains(grid_from_world.point(world_mm))) return false;
    const Vec3 from_entry = world_mm - plan.entry_mm;
    const double along_mm = from_entry.dot(axis);
    return along_mm < reamers_depth_mm && (from_entry - along_mm * axis).norm() < reamers_reach_mm;
  });
}

void keep_surroundings(const TriangleMesh& around, case_::Side side,
                       const std::filesystem::path& case_folder) {
  const std::filesystem::path file = case_folder / surroundings_file;
  if (!around.triangles.empty()) return write_ply(file, around, case_::frame_in_words(side));
  std::error_code failed;
  std::filesystem::remove(file, failed);
  if (failed) throw Error(ErrorKind::io, "cannot remove " + file.string() + ": " + failed.message());
}

TriangleMesh kept_surroundings(const std::filesystem::path& case_folder) {
  const std::filesystem::path file = case_folder / surroundings_file;
  if (!std::filesystem::exists(file)) return {};
  try {
    TriangleMesh around = load_mesh(file);
    around.normals = smooth_normals(around);
    return around;
  } catch (const Error& e) {
    log::warn("drawn without what lies around the bone: " + std::string(e.what()));
    return {};
  }
}

}  // namespace ream::ct
