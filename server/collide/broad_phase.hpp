#pragma once
#include "geometry/box.hpp"

namespace ream::collide {

/// Volume of interest: the part of the tool's box, tool frame, in which bone may lie (thesis 4.4). Always an
/// over-estimate, so culling by it never changes a result.
struct Voi {
  bool touching = false;  ///< false: nothing to do this tick
  Aabb box_tool_mm;
};

/// `bone_box_grid` is around the bone that is left (SolidCells::bounds_mm).
/// OBB/SAT test of the tool's box (tool frame) against the bone's box (grid frame), each grown by `reach_mm`,
/// then the overlap of the bone's box, expressed in the tool frame, with the tool's box.
Voi broad_phase(const Aabb& bone_box_grid, const Aabb& tool_box_tool, const Pose& grid_from_tool,
                double reach_mm) noexcept;

}  // namespace ream::collide
