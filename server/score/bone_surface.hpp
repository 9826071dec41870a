#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "score/ray_lattice.hpp"
#include "voxel/voxel_grid.hpp"

namespace ream::score {

/// Coverage as scoring reads it, in the order of VoxelGrid::index, with the bone at rest. Both outlive it.
struct CoverageView {
  const voxel::VoxelGrid& grid;
  const uint8_t* coverage;
};

/// Finds surfaces of bone along lines, finer than a voxel.
///
/// A tool leaves coverage that falls from 255 to 0 within one voxel, which trilinear interpolation bends: its
/// level 127.5 is up to 0.09 voxels beside the surface, depending on where the surface lies among the voxels.
/// What the coverage sums up to across the surface is not bent. So where coverage is whole on one side and
/// none on the other within two voxels of that level, the surface is put where the sum has it; elsewhere (in
/// the blur of a scan, at a thin wall), at the level.
class SurfaceFinder {
 public:
  explicit SurfaceFinder(const CoverageView& bone);

  /// The first surface from the air into bone on going from `from_mm` to `to_mm` along the line, as mm from
  /// its point; `from_mm` must lie in the air, or it is said itself. World frame.
  std::optional<double> into_bone(const Vec3& point_mm, const Vec3& direction, double from_mm,
                                  double to_mm) const;
  /// The first surface from bone into the air, at the level; `from_mm` lies in bone.
  std::optional<double> out_of_bone(const Vec3& point_mm, const Vec3& direction, double from_mm,
                                    double to_mm) const;
  /// Coverage at a world point, 0 to 255.
  double coverage_at(const Vec3& world_mm) const;

  /// Depth along a ray from `from_mm` (less a little) on; no_surface_mm where nothing is met, and for
  /// `from_mm` itself being that.
  double depth(const RayLattice& rays, size_t ray, double from_mm) const;
  /// Depths along every ray from `from_mm[ray]` (less a little) on; no_surface_mm where none is met.
  std::vector<double> depths(const RayLattice& rays, const std::vector<double>& from_mm) const;
  /// The same from outside the grid on.
  std::vector<double> depths(const RayLattice& rays) const;
  /// Where the line is within the grid's box, a voxel more on both sides; empty when it misses it.
  std::optional<std::pair<double, double>> span_in_grid(const Vec3& point_mm, const Vec3& direction) const;

 private:
  struct Line {
    Vec3 point_mm, direction;  // grid frame
  };
  Line line_of(const Vec3& point_mm, const Vec3& direction) const;
  double at(const Line& line, double s_mm) const;
  int voxel_at(const Line& line, double s_mm) const;
  double level_between(const Line& line, double air_mm, double bone_mm) const;
  double refined(const Line& line, double level_mm) const;

  CoverageView bone_;
  Pose grid_from_world_;
  double step_mm_, reach_mm_;
};

}  // namespace ream::score
