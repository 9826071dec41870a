#include "session/simulation/reamed_pictures.hpp"

#include <Eigen/Geometry>

#include "ct/build/surroundings.hpp"
#include "geometry/mesh_io.hpp"
#include "surface/block_mesh.hpp"

namespace ream::session {
namespace {

constexpr int picture_width = 1280, picture_height = 960;
constexpr double camera_distance_mm = 105.0;
constexpr int surface_threads = 2;

/// Triangles of the surface that removal has made, and the rest.
struct Parts {
  TriangleMesh fresh, native;
};

/// True when the voxel that holds the point, or one beside it, has lost coverage.
bool is_fresh(const voxel::BoneModel& bone, const std::vector<uint8_t>& before, const Vec3& point_mm) {
  const Vec3i at = bone.grid.voxel_at(point_mm);
  for (int axis = 0; axis < 3; ++axis)
    for (int step = -1; step <= 1; ++step) {
      Vec3i o = at;
      o[axis] += step;
      if (!bone.grid.contains(o)) continue;
      const size_t i = bone.grid.index(o);
      if (bone.coverage[i] < before[i]) return true;
    }
  return false;
}

Parts split(const TriangleMesh& surface, const voxel::BoneModel& bone, const std::vector<uint8_t>& before) {
  std::vector<uint8_t> fresh(surface.vertices_mm.size());
  for (size_t i = 0; i < fresh.size(); ++i)
    fresh[i] = is_fresh(bone, before, surface.vertices_mm[i].cast<double>());
  Parts parts;
  parts.fresh.vertices_mm = parts.native.vertices_mm = surface.vertices_mm;
  parts.fresh.normals = parts.native.normals = surface.normals;
  for (const auto& t : surface.triangles)
    (fresh[t[0]] && fresh[t[1]] && fresh[t[2]] ? parts.fresh : parts.native).triangles.push_back(t);
  return parts;
}

void draw_picture(const case_::Case& bone_case, const TriangleMesh& surface,
                  const std::vector<uint8_t>& before, const TriangleMesh& around,
                  const std::filesystem::path& png) {
  const Parts parts = split(surface, bone_case.bone, before);
  std::vector<render::Layer> layers(2);
  layers[0].mesh = &parts.native;
  layers[1].mesh = &parts.fresh;
  layers[1].colour = render::cut_bone_colour;
  for (auto& layer : layers) layer.world_from_mesh = bone_case.bone.grid.world_from_grid;
  const TriangleMesh beyond = ct::beyond_reach(around, plan_of(bone_case));
  if (!beyond.triangles.empty()) layers.emplace_back().mesh = &beyond;
  const Vec3 superior = bone_case.glenoid ? bone_case.glenoid->superior : Vec3::UnitZ();
  const render::Camera camera = glenoid_camera(plan_of(bone_case), superior, camera_distance_mm);
  render::write_png(png, render::draw(layers, camera, picture_width, picture_height));
}

}  // namespace

render::Camera glenoid_camera(const case_::Plan& plan, const Vec3& superior, double distance_mm) {
  const Vec3 axis = plan.axis_direction.normalized();
  Vec3 up = superior - axis * axis.dot(superior);
  up = up.norm() > 1e-6 ? Vec3(up.normalized()) : Vec3(rotation_with_z_along(axis).col(0));
  const Vec3 side = axis.cross(up);
  render::Camera camera;
  camera.target_mm = plan.entry_mm;
  camera.eye_mm = plan.entry_mm + distance_mm * (-0.86 * axis + 0.30 * up + 0.41 * side);
  camera.up = up;
  return camera;
}

TriangleMesh reamed_surface(const case_::Case& bone_case, int stride) {
  const voxel::BoneModel& bone = bone_case.bone;
  return surface::whole_surface(bone.grid, bone.coverage.data(), surface_threads, stride)
      .transformed(bone.grid.world_from_grid);
}

void write_picture(const case_::Case& bone_case, const std::vector<uint8_t>& before,
                   const std::filesystem::path& png, const TriangleMesh& around) {
  const voxel::BoneModel& bone = bone_case.bone;
  draw_picture(bone_case, surface::whole_surface(bone.grid, bone.coverage.data()), before, around, png);
}

void write_reamed_pictures(const Simulation& simulation, const std::vector<uint8_t>& before,
                           const std::filesystem::path& folder) {
  const voxel::BoneModel& bone = simulation.bone_case.bone;
  const TriangleMesh surface = surface::whole_surface(bone.grid, bone.coverage.data());
  write_ply(folder / "reamed.ply", surface.transformed(bone.grid.world_from_grid),
            case_::frame_in_words(simulation.bone_case.side));
  draw_picture(simulation.bone_case, surface, before, {}, folder / "snapshot.png");
}

}  // namespace ream::session
