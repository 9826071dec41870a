#pragma once
#include <optional>
#include <random>

#include "collide/contact/contact_shell.hpp"
#include "collide/contact/narrow_phase.hpp"
#include "collide/removal/removal.hpp"
#include "collide/removal/removal_schedule.hpp"
#include "shell/swept_profile.hpp"

namespace ream::test {

/// A small block of bone with a curved top, mixed densities and a rough surface of half-covered voxels, and a
/// reamer with a nipple: everything that narrow phase and removal look at. The same for the same seed.
struct ReamingScene {
  explicit ReamingScene(unsigned seed, const Vec3i& dims = {96, 88, 72}) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> any_byte(0, 255);
    voxel::VoxelGrid grid;
    grid.dims = dims;
    grid.spacing_mm = {0.25, 0.28, 0.25};
    bone = voxel::make_bone(grid);
    const Vec3 middle = grid.bounds_mm().centre();
    for (size_t i = 0; i < bone.coverage.size(); ++i) {
      const Vec3 p = grid.centre_mm(grid.coordinates(i));
      const double top = 11.0 - 0.02 * (p - middle).head<2>().squaredNorm();
      bone.density.writable()[i] = static_cast<uint8_t>(any_byte(random));
      if (p.z() < top) bone.coverage[i] = p.z() > top - 0.25 ? static_cast<uint8_t>(any_byte(random)) : 255;
    }
    tool = shell::make_tool("ellipse 8,5 nipple 2,3");
    contact = collide::make_contact_shell(shell::make_point_shell(tool, 0.25), grid.spacing_mm.maxCoeff());
    profile = shell::swept_profile(tool.profile, collide::RemovalSchedule::needed_margin_mm(grid));
    distance = voxel::brick_distance(bone);
    cells.emplace(bone);
  }

  collide::NarrowPhaseInput contact_input() const { return {contact, bone, distance, *cells}; }

  /// The tool's apex `depth_mm` below the top of the bone, pointing down, tilted by a small rotation vector.
  QuantisedPose pose(double depth_mm, const Vec3& tilt, const Vec3& shift_mm) const {
    const Vec3 middle = bone.grid.bounds_mm().centre();
    const Mat3 down = Eigen::DiagonalMatrix<double, 3>(1.0, -1.0, -1.0);
    return quantised(
        {rotation_from_small_vector(tilt) * down, Vec3(middle.x(), middle.y(), 11.0 - depth_mm) + shift_mm});
  }
  QuantisedPose random_pose(std::mt19937& random) const {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const Vec3 tilt(0.6 * unit(random), 0.6 * unit(random), unit(random));
    return pose(3.0 + 5.0 * unit(random), tilt, Vec3(9.0 * unit(random), 8.0 * unit(random), 0.0));
  }
  collide::Voi voi(const QuantisedPose& grid_from_tool) const {
    return collide::broad_phase(cells->bounds_mm(), contact.bounds_mm, dequantised(grid_from_tool), 1.0);
  }

  voxel::BoneModel bone;
  shell::Tool tool;
  collide::ContactShell contact;
  shell::SweptProfile profile;
  voxel::BrickDistance distance;
  std::optional<voxel::SolidCells> cells;
};

/// Grids of scenes and buffer limits, bytes, that cut them into `parts`; the tool meets bone in all of them.
struct SmallParts {
  Vec3i dims;
  size_t max_buffer_bytes;
  int parts;
};
inline const SmallParts small_parts[] = {
    {{112, 96, 48}, 300000, 2}, {{96, 80, 48}, 1 << 17, 3}, {{112, 96, 48}, 1 << 17, 4}};

}  // namespace ream::test
