#include "session/simulation/reamed_pictures.hpp"

#include <Eigen/Geometry>

#include "ct/build/surroundings.hpp"
#include "geometry/mesh_io.hpp"
#include "geometry/split_mesh.hpp"
#include "surface/removed_share.hpp"

namespace ream::session {
namespace {

constexpr int picture_width = 1280, picture_height = 960;
constexpr double camera_distance_mm = 105.0;
constexpr int surface_threads = 2;

void draw_picture(const case_::Case& bone_case, const TriangleMesh& surface,
                  const std::vector<uint8_t>& before, const TriangleMesh& around,
                  const std::filesystem::path& png) {
  const voxel::BoneModel& bone = bone_case.bone;
  const SplitMesh parts = split_at(
      surface, surface::removed_shares(surface.vertices_mm, bone.grid, before.data(), bone.coverage.data()),
      surface::cut_share);
  std::vector<render::Layer> layers(2);
  layers[0].mesh = &parts.below;
  layers[1].mesh = &parts.above;
  layers[1].colour = render::cut_bone_colour;
  for (auto& layer : layers) layer.world_from_mesh = bone.grid.world_from_grid;
  const TriangleMesh beyond = ct::beyond_reach(around, plan_of(bone_case), bone.grid);
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
