#pragma once
#include <algorithm>
#include <cmath>

#include "case/case.hpp"
#include "core/units.hpp"
#include "support/shoulder_landmarks.hpp"

namespace ream::test {

/// A glenoid by formulas: an elliptic vault that narrows medially, its face a sphere, under it a plate,
/// around it a shell of compact bone. A left one is the mirror image in x = 0 of the right one.
struct AnalyticGlenoid {
  ShoulderShape shoulder;  ///< side, version, inclination, height and width of the face
  double radius_mm = 36.0, plate_mm = 1.9, shell_mm = 1.2, vault_mm = 22.0;
  double compact_g_cc = 1.5, spongy_g_cc = 0.56;

  /// Right shoulder; `n` lateral.
  struct Frame {
    Vec3 centre, n, superior, anterior;
  };
  Frame frame() const {
    ShoulderShape right = shoulder;
    right.side = case_::Side::right;
    const case_::Landmarks l = shoulder_landmarks(right);
    Frame f;
    f.centre = *l.glenoid_centre_mm;
    f.superior = (*l.superior_rim_mm - *l.inferior_rim_mm).normalized();
    f.anterior = (*l.anterior_rim_mm - *l.posterior_rim_mm).normalized();
    f.n = (l.humeral_head->centre_mm - f.centre).normalized();
    return f;
  }
  Vec3 mirrored(const Vec3& v) const {
    return shoulder.side == case_::Side::left ? Vec3(-v.x(), v.y(), v.z()) : v;
  }
};

/// The same, prepared for many questions. World points.
class GlenoidFormulas {
 public:
  explicit GlenoidFormulas(const AnalyticGlenoid& glenoid)
      : g_(glenoid), f_(glenoid.frame()), sphere_(f_.centre + glenoid.radius_mm * f_.n) {}

  /// Distance to the sphere of the face, positive under it (in bone).
  double depth_mm(const Vec3& world) const { return (g_.mirrored(world) - sphere_).norm() - g_.radius_mm; }
  /// Distance to the wall of the vault, positive outside; first order.
  double beyond_wall_mm(const Vec3& world) const {
    const Vec3 p = g_.mirrored(world) - f_.centre;
    const double t = std::clamp(-p.dot(f_.n) / 24.0, -0.3, 1.0);
    const double a = 0.5 * g_.shoulder.height_mm * (1.0 - 0.15 * t),
                 b = 0.5 * g_.shoulder.width_mm * (1.0 - 0.45 * t);
    const double x = p.dot(f_.superior), y = p.dot(f_.anterior);
    const double along = x / a, across = y / b, r = std::hypot(along, across);
    if (r < 0.2) return -b;
    const double slope = std::hypot(along / a, across / b) / r;
    return (r - 1.0) / slope;
  }
  /// Signed distance to the surface, negative in bone.
  double distance_mm(const Vec3& world) const {
    const double medial = -(g_.mirrored(world) - f_.centre).dot(f_.n) - g_.vault_mm;
    return std::max({-depth_mm(world), beyond_wall_mm(world), medial});
  }
  bool solid(const Vec3& world) const { return distance_mm(world) < 0.0; }
  double density_g_cc(const Vec3& world) const {
    return depth_mm(world) < g_.plate_mm || -beyond_wall_mm(world) < g_.shell_mm ? g_.compact_g_cc
                                                                                 : g_.spongy_g_cc;
  }
  Vec3 sphere_centre() const { return g_.mirrored(sphere_); }
  const AnalyticGlenoid& glenoid() const { return g_; }
  /// Version and inclination of a face across an axis into the bone, degrees.
  std::pair<double, double> angles_deg(const Vec3& axis_world) const {
    const Vec3 n = -g_.mirrored(axis_world);
    const double turn = radians_from_degrees(g_.shoulder.plane_deg);
    const Vec3 lateral(-std::cos(turn), -std::sin(turn), 0.0),
        posterior(-std::sin(turn), std::cos(turn), 0.0);
    return {degrees_from_radians(-std::atan2(n.dot(posterior), n.dot(lateral))),
            degrees_from_radians(std::atan2(n.z(), n.dot(lateral)))};
  }

 private:
  AnalyticGlenoid g_;
  AnalyticGlenoid::Frame f_;
  Vec3 sphere_;
};

/// Its voxels: coverage falls from 255 to 0 within one voxel across the surface, as a tool leaves it.
inline voxel::BoneModel bone_of(const AnalyticGlenoid& glenoid, double voxel_mm) {
  const GlenoidFormulas formulas(glenoid);
  const AnalyticGlenoid::Frame f = glenoid.frame();
  Aabb box;
  const double across = 0.5 * std::max(glenoid.shoulder.height_mm, glenoid.shoulder.width_mm);
  for (const double side : {-1.0, 1.0})
    for (const Vec3& corner : {Vec3(f.centre + side * 0.55 * glenoid.shoulder.height_mm * f.superior),
                               Vec3(f.centre + side * 0.6 * glenoid.shoulder.width_mm * f.anterior)}) {
      box.include(glenoid.mirrored(corner + (across * across / glenoid.radius_mm) * f.n));
      box.include(glenoid.mirrored(corner - (glenoid.vault_mm + 1.0) * f.n));
    }
  voxel::VoxelGrid grid;
  grid.dims = voxel::whole_bricks(((box.max - box.min) / voxel_mm).array().ceil().matrix().cast<int>());
  grid.spacing_mm = Vec3::Constant(voxel_mm);
  grid.world_from_grid.translation_mm = box.min;
  if (glenoid.shoulder.side == case_::Side::left)  // the grid's voxels are mirror images, too
    grid.world_from_grid.translation_mm.x() = box.max.x() - grid.dims.x() * voxel_mm;
  voxel::BoneModel bone = voxel::make_bone(grid);
  std::vector<uint8_t>& density = bone.density.writable();
  for (uint32_t brick = 0; brick < grid.brick_count(); ++brick) {
    const Vec3i first = grid.brick_coordinates(brick) * voxel::brick_edge;
    const Vec3 middle = grid.world_from_grid.point(grid.centre_mm(first) + Vec3::Constant(3.5 * voxel_mm));
    const bool far_outside = formulas.distance_mm(middle) > 16.0 * voxel_mm;
    for (int i = 0; i < voxel::brick_voxels && !far_outside; ++i) {
      const size_t at = grid.brick_base(brick) + static_cast<size_t>(i);
      const Vec3 world = grid.world_from_grid.point(grid.centre_mm(first + Vec3i(i % 8, i / 8 % 8, i / 64)));
      const double level = 127.5 - 255.0 * formulas.distance_mm(world) / voxel_mm;
      bone.coverage[at] = static_cast<uint8_t>(std::clamp(std::floor(level + 0.5), 0.0, 255.0));
      if (bone.coverage[at] != 0) density[at] = voxel::density_code(formulas.density_g_cc(world));
    }
  }
  return bone;
}

}  // namespace ream::test
