#pragma once
#include <array>

#include "force/feed_model.hpp"
#include "shell/tool.hpp"

namespace ream::sim {

/// The tool's lip. It follows the cutting surface outwards from its offset in
/// pieces of at most 0.1 mm as seen along the axis; walls along the axis and what lies under a wider part
/// inside of it cut nothing when the tool is fed.
force::Lip cutting_lip(const shell::ToolProfile& profile);

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
