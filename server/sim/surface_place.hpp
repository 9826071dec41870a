#pragma once
#include <array>

#include "shell/tool.hpp"

namespace ream::sim {

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
