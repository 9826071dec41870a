#pragma once
#include <array>

#include "force/feed_model.hpp"
#include "shell/tool.hpp"

namespace ream::sim {

/// What the feed models know of a tool. The lip follows the cutting surface outwards from its offset in
/// pieces of at most 0.1 mm as seen along the axis; walls along the axis and what lies under a wider part
/// inside of it cut nothing when the tool is fed. The seated area is that of the cutting surface within
/// `seated_depth_mm` (the plan's depth; at least 0.1 mm is taken) of its most protruding place, as in flat
/// bone.
force::CuttingTool cutting_tool(const shell::ToolProfile& profile, double seated_depth_mm);

/// Where on a reamer's cutting surface contact with a given mean normal lies. A convex cap has each normal in
/// one place of its meridian; where the tool is seated evenly the mean normal is the axis and the place the
/// apex.
class SurfacePlace {
 public:
  SurfacePlace() = default;
  explicit SurfacePlace(const shell::ToolProfile& profile);

  /// Tool frame. `normal`: unit, out of the tool.
  Vec3 point_mm(const Vec3& normal) const noexcept;

 private:
  static constexpr size_t steps = 64;
  /// By the normal's part across the axis, 0 to 1 in even steps.
  std::array<shell::ProfilePoint, steps + 1> places_{};
};

}  // namespace ream::sim
