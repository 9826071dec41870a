#include "bench/glenoid_block.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "bench/depth_of_share.hpp"

namespace ream::bench {
namespace {

constexpr double middle_mm = 0.5 * glenoid_cube_mm;
constexpr double face_z_mm = 36.0, face_radius_mm = 35.0, rim_z_mm = 41.0, bottom_z_mm = 4.0;
constexpr double half_width_mm = 14.0, half_height_mm = 20.0;
constexpr int pose_search_resolution = 128;

/// How far below the spherical face, mm; negative in front of it.
double depth_under_face_mm(const Vec3& p) {
  return (p - Vec3(middle_mm, middle_mm, face_z_mm + face_radius_mm)).norm() - face_radius_mm;
}

/// At least as near as the surface truly is (each term changes by at most 1 a mm), mm, negative in bone;
/// exact at the face.
double signed_distance_mm(const Vec3& p) {
  const double across = (p.x() - middle_mm) / half_width_mm, along = (p.y() - middle_mm) / half_height_mm;
  const double column_mm = half_width_mm * (std::sqrt(across * across + along * along) - 1.0);
  return std::max({-depth_under_face_mm(p), p.z() - rim_z_mm, bottom_z_mm - p.z(), column_mm});
}

uint8_t density_at(const Vec3& p) {
  constexpr double face_g_cc = 1.5, deep_g_cc = 0.4, fall_g_cc_mm = 0.35;
  return voxel::density_code(std::max(deep_g_cc, face_g_cc - fall_g_cc_mm * depth_under_face_mm(p)));
}

void fill_brick(voxel::BoneModel& bone, uint32_t brick) {
  const voxel::VoxelGrid& grid = bone.grid;
  const Vec3i first = grid.brick_coordinates(brick) * voxel::brick_edge;
  const Vec3 half = 0.5 * voxel::brick_edge * grid.spacing_mm;
  const Vec3 centre = (first.cast<double>().array() * grid.spacing_mm.array()).matrix() + half;
  const double voxel_mm = grid.spacing_mm.x();
  // Beyond this no voxel of the brick is cut by the surface.
  const double reach_mm = half.norm() + voxel_mm;
  const double brick_mm = signed_distance_mm(centre);
  if (brick_mm > reach_mm) return;
  for (int w = 0; w < voxel::brick_edge; ++w)
    for (int v = 0; v < voxel::brick_edge; ++v)
      for (int u = 0; u < voxel::brick_edge; ++u) {
        const Vec3i at = first + Vec3i(u, v, w);
        const Vec3 p = grid.centre_mm(at);
        const double distance_mm = brick_mm < -reach_mm ? -voxel_mm : signed_distance_mm(p);
        const double level = std::clamp(128.0 - 255.0 * distance_mm / voxel_mm, 0.0, 255.0);
        const size_t i = grid.index(at);
        bone.coverage[i] = static_cast<uint8_t>(level);
        if (bone.coverage[i] > 0) bone.density.writable()[i] = density_at(p);
      }
}

}  // namespace

voxel::BoneModel glenoid_block(int resolution) {
  voxel::VoxelGrid grid;
  grid.dims = Vec3i::Constant(resolution);
  grid.spacing_mm = Vec3::Constant(glenoid_cube_mm / resolution);
  voxel::BoneModel bone = voxel::make_bone(grid);
  for (uint32_t brick = 0; brick < grid.brick_count(); ++brick) fill_brick(bone, brick);
  return bone;
}

QuantisedPose pose_at_face(double depth_mm, const Vec3& shift_mm, const Vec3& tilt_rad) {
  const Mat3 towards_bone = rotation_with_z_along(-Vec3::UnitZ());
  return quantised({towards_bone * rotation_from_small_vector(tilt_rad),
                    Vec3(middle_mm, middle_mm, face_z_mm - depth_mm) + shift_mm});
}

std::vector<QuantisedPose> severe_poses(const MortonShell& shell, int count, unsigned seed) {
  constexpr double least_share = 0.05, largest_share = 0.20;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> one(-1.0, 1.0);
  Voxmap voxmap = voxmap_of(glenoid_block(pose_search_resolution));
  std::vector<QuantisedPose> poses;
  for (int i = 0; i < count; ++i) {
    const double share = least_share + (largest_share - least_share) * (i + 0.5) / count;
    const double x_mm = 3.0 * one(random), y_mm = 3.0 * one(random);
    const double tilt_x = 0.15 * one(random), tilt_y = 0.15 * one(random), tilt_z = 0.15 * one(random);
    const auto pose = [&](double depth_mm) {
      return pose_at_face(depth_mm, Vec3(x_mm, y_mm, 0.0), Vec3(tilt_x, tilt_y, tilt_z));
    };
    poses.push_back(pose(depth_of_share(voxmap, shell, share, -15.0, 25.0, pose)));
  }
  return poses;
}

}  // namespace ream::bench
