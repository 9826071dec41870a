#include "app/reamed_pictures.hpp"

#include "geometry/mesh_io.hpp"
#include "surface/whole_surface.hpp"

namespace ream::app {
namespace {

constexpr int picture_width = 1280, picture_height = 960;
constexpr double camera_distance_mm = 105.0;

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

void write_reamed_pictures(const Rig& rig, const std::vector<uint8_t>& before,
                           const std::filesystem::path& folder) {
  const voxel::BoneModel& bone = rig.bone_case.bone;
  const TriangleMesh surface = surface::whole_surface(bone.grid, bone.coverage.data());
  write_ply(folder / "reamed.ply", surface.transformed(bone.grid.world_from_grid),
            case_::frame_in_words(rig.bone_case.side));

  const Parts parts = split(surface, bone, before);
  std::vector<render::Layer> layers(2);
  layers[0].mesh = &parts.native;
  layers[1].mesh = &parts.fresh;
  layers[1].colour = Vec3f(0.80f, 0.42f, 0.34f);
  for (auto& layer : layers) layer.world_from_mesh = bone.grid.world_from_grid;
  const Vec3 superior = rig.bone_case.glenoid ? rig.bone_case.glenoid->superior : Vec3::UnitZ();
  const render::Camera camera = glenoid_camera(rig.model.plan, superior, camera_distance_mm);
  render::write_png(folder / "snapshot.png", render::draw(layers, camera, picture_width, picture_height));
}

}  // namespace ream::app
