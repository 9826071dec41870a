#pragma once
#include <functional>

#include "core/units.hpp"
#include "shell/swept_profile.hpp"
#include "shell/tool.hpp"
#include "sim/model.hpp"
#include "sim/settings.hpp"
#include "support/test_bone.hpp"

namespace ream::test {

inline constexpr double post_top_mm = 9.0, post_voxel_mm = 0.3;

/// Bone whose cross-section has this signed distance (mm, negative inside) from its border, plan frame of
/// slab_plan(bone, post_top_mm).
inline voxel::BoneModel post(const std::function<double(double, double)>& outside_mm, double density_g_cc) {
  voxel::BoneModel bone = slab({136, 136, 48}, post_voxel_mm, post_top_mm, density_g_cc);
  const Pose plan_from_world = sim::world_from_plan(slab_plan(bone, post_top_mm)).inverse();
  for (int w = 0; w < 48; ++w)
    for (int v = 0; v < 136; ++v)
      for (int u = 0; u < 136; ++u) {
        const Vec3 at = plan_from_world.point(
            bone.grid.world_from_grid.point((Vec3(u, v, w) + Vec3::Constant(0.5)) * post_voxel_mm));
        const double kept =
            std::clamp(127.5 - 255.0 * outside_mm(at.x(), at.y()) / post_voxel_mm, 0.0, 255.0);
        uint8_t& coverage = bone.coverage[bone.grid.index(u, v, w)];
        coverage = std::min(coverage, static_cast<uint8_t>(kept));
      }
  return bone;
}

/// A round one, `aside_mm` off the plan's axis.
inline voxel::BoneModel round_post(double area_mm2, double aside_mm, double density_g_cc) {
  const double radius_mm = std::sqrt(area_mm2 / pi);
  return post([=](double x, double y) { return std::hypot(x - aside_mm, y) - radius_mm; }, density_g_cc);
}

/// The face that the edge model's reference stands for, 37.5 x 24.4 mm, in the shape of the thesis' reamer:
/// it is seated from the first touch.
inline voxel::BoneModel seated_face(double density_g_cc) {
  const shell::ToolProfile profile = shell::make_tool("thesis-appendix-a").profile;
  voxel::BoneModel bone = post(
      [](double x, double y) {
        const double scale = std::hypot(x / 18.75, y / 12.2);
        return (scale - 1.0) * std::hypot(x, y) / std::max(scale, 1e-9);
      },
      density_g_cc);
  const Pose plan_from_world = sim::world_from_plan(slab_plan(bone, post_top_mm)).inverse();
  for (size_t i = 0; i < bone.coverage.size(); ++i) {
    const Vec3 centre = (bone.grid.coordinates(i).cast<double>() + Vec3::Constant(0.5)) * post_voxel_mm;
    const Vec3 at = plan_from_world.point(bone.grid.world_from_grid.point(centre));
    const double above =
        shell::swept_distance_mm(profile, std::hypot(at.x(), at.y()), at.z() - post_top_mm + 1.0);
    const double left = std::clamp(127.5 + 255.0 * above / post_voxel_mm, 0.0, 255.0);
    bone.coverage[i] = std::min(bone.coverage[i], static_cast<uint8_t>(left));
  }
  return bone;
}

}  // namespace ream::test
