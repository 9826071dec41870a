#pragma once
#include "shell/meridian.hpp"
#include "shell/tool.hpp"

namespace ream::score {

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
