#pragma once
#include <vector>

#include "shell/meridian.hpp"
#include "shell/tool.hpp"

namespace ream::score {

/// A surface of revolution about an axis that points into the bone, as height over radius: how far it lies
/// behind its apex. Of a reamer's cutting surface, or of an implant's back.
class CuttingMeridian {
 public:
  CuttingMeridian() = default;
  /// The cutting surface of a profile, continued flat to the axis. Error invalid_input without any.
  explicit CuttingMeridian(const shell::ToolProfile& profile);
  /// A sphere out to a radius.
  static CuttingMeridian sphere(double radius_mm, double outer_mm);

  double outer_mm() const { return radius_mm_.empty() ? 0.0 : radius_mm_.back(); }
  /// Height behind the apex at a radius, mm, positive; beyond the outer radius that of the rim.
  double behind_mm(double radius_mm) const;
  /// Cosine of the angle between its normal and the axis.
  double slope_cosine(double radius_mm) const;

 private:
  size_t segment_of(double radius_mm) const;

  std::vector<double> radius_mm_, behind_mm_;  ///< radius ascending from 0
};

/// What a tool's cutting surface has swept once the tool has come in along its axis: the solid of revolution
/// under its meridian (flat to the axis where a nipple stands), that goes straight back behind its rim.
class SweptFront {
 public:
  /// `back_mm`: how far it goes back behind the rim. Error invalid_input without a cutting surface.
  SweptFront(const shell::ToolProfile& profile, double back_mm);

  /// Signed distance of a point of the tool frame, mm, negative inside.
  double distance_mm(const Vec3& tool_mm) const;
  /// Its meridian, closed at the back.
  const shell::ToolProfile& profile() const { return meridian_.profile(); }
  double outer_mm() const { return meridian_.profile().max_radius_mm(); }

 private:
  shell::Meridian meridian_;
};

}  // namespace ream::score
