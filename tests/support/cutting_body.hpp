#pragma once
#include <filesystem>
#include <vector>

#include "geometry/pose.hpp"

namespace ream::test {

/// Corner of a meridian: radius and height, mm, tool frame.
struct MeridianPoint {
  double radius_mm = 0.0, z_mm = 0.0;
};

/// The solid of revolution that a reamer's cutting surface sweeps, by code of its own (no part of
/// server/shell): under the given meridian, out to its last radius, down to `back_mm` behind its lowest
/// point. Doubles throughout.
class CuttingBody {
 public:
  /// `front`: from radius 0 to the rim, radii ascending. Distances are exact to about 2 um up to reach_mm.
  CuttingBody(std::vector<MeridianPoint> front, double back_mm);

  static constexpr double reach_mm = 1.2;
  /// Signed distance (mm, negative inside), clamped to +-reach_mm.
  double distance_mm(double radius_mm, double z_mm) const;

  double rim_radius_mm() const { return front_.back().radius_mm; }
  /// Radius of a sphere about the tool's origin that holds the body.
  double size_mm() const;

 private:
  double exact_distance_mm(double radius_mm, double z_mm) const;

  std::vector<MeridianPoint> front_;
  double floor_z_mm_ = 0.0, top_z_mm_ = 0.0;
  int radius_count_ = 0, z_count_ = 0;
  std::vector<float> table_mm_;
};

/// Meridian of a cap of the sphere of that radius, apex at the origin.
std::vector<MeridianPoint> sphere_meridian(double radius_mm, double outer_radius_mm);
/// The same of an ellipsoid with semi-axes a across and b along the axis.
std::vector<MeridianPoint> ellipse_meridian(double a_mm, double b_mm);

/// Highest z that any triangle of a binary STL reaches at each radius about the tool's axis, by sampling all
/// triangles densely. Inside `nipple_radius_mm`, where the tool guides and removes nothing, it continues
/// flat.
std::vector<MeridianPoint> stl_meridian(const std::filesystem::path& stl, const Pose& tool_from_mesh,
                                        double nipple_radius_mm);

}  // namespace ream::test
