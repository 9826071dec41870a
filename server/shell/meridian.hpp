#pragma once
#include <cstdint>
#include <vector>

#include "shell/tool.hpp"

namespace ream::shell {

/// Point of a tool's surface nearest to some place, in the half plane (radius, z) of the tool frame.
struct MeridianHit {
  size_t segment = 0;                      ///< of the profile; the earlier one at a corner
  double signed_distance_mm = 0;           ///< from the surface, negative inside the tool
  double normal_radial = 0, normal_z = 1;  ///< unit, outward; at a corner, along the line to the corner
};

/// Nearest point of a profile: at least two points, no two consecutive ones equal, both ends on the axis.
/// Exact but for rounding.
MeridianHit nearest_on_profile(const ToolProfile& profile, double radius_mm, double z_mm);

/// A profile prepared for many such questions, with the same answers: the grid of candidates only leaves out
/// segments that cannot be nearest.
class Meridian {
 public:
  /// `reach_mm` is how far outside the profile's box questions are answered fast; farther ones are answered
  /// too.
  Meridian(ToolProfile profile, double reach_mm);

  MeridianHit nearest(double radius_mm, double z_mm) const;
  const ToolProfile& profile() const { return profile_; }

 private:
  void list_candidates(double cell_radius_mm, double cell_z_mm, double half_diagonal_mm);

  ToolProfile profile_;
  double min_z_mm_ = 0, cell_mm_ = 1;
  int radius_cells_ = 0, z_cells_ = 0;
  std::vector<uint32_t> first_candidate_;  ///< per cell, one more at the end
  std::vector<uint32_t> candidates_;
};

/// The same surface with fewer corners: no removed corner is farther than `tolerance_mm` from the new line;
/// role boundaries stay (Douglas and Peucker 1973).
ToolProfile simplified(const ToolProfile& profile, double tolerance_mm);

}  // namespace ream::shell
