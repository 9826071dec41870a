#pragma once
#include <vector>

#include "shell/tool.hpp"

namespace ream::shell {

/// Bone behind the outermost cutting point up to this far back counts as swept, so that the thin wedge of the
/// cutting body at its rim still clears whole voxels (engineering choice).
inline constexpr double rim_backing_mm = 0.5;

/// Signed distance (mm, negative inside) to the body that the cutting surface sweeps by spinning: the solid
/// of revolution between the cutting meridian (continued flat to the axis where a nipple stands) and a plane
/// rim_backing_mm behind its lowest cutting point. Tabulated over z and r^2 so that the deciding path needs
/// only
/// + - x and comparisons; outside the table the distance is larger than `margin_mm`.
struct SweptProfile {
  float z_min_mm = 0, z_step_mm = 0, inverse_z_step = 0;
  float r2_step_mm2 = 0, inverse_r2_step = 0;
  int z_count = 0, r2_count = 0;
  std::vector<float> distance_mm;  ///< [z][r2], r2 fastest

  double max_radius_mm = 0;  ///< of the swept body
  double body_min_z_mm = 0, body_max_z_mm = 0;
  double margin_mm = 0;

  /// Bilinear look-up exactly as kernels/removal.cl does it: fr = r2 * inverse_r2_step, fz = (z - z_min) *
  /// inverse_z_step, truncated, then the mix along r2 first. `far` outside the table.
  float at(float r2_mm2, float z_mm) const noexcept {
    const float fr = r2_mm2 * inverse_r2_step, fz = (z_mm - z_min_mm) * inverse_z_step;
    if (!(fz >= 0.0f) || !(fz < static_cast<float>(z_count - 1)) || !(fr < static_cast<float>(r2_count - 1)))
      return far;
    const int ir = static_cast<int>(fr), iz = static_cast<int>(fz);
    const float tr = fr - static_cast<float>(ir), tz = fz - static_cast<float>(iz);
    const float* low = distance_mm.data() + iz * r2_count + ir;
    const float* high = low + r2_count;
    const float a = low[0] + tr * (low[1] - low[0]);
    const float b = high[0] + tr * (high[1] - high[0]);
    return a + tz * (b - a);
  }
  static constexpr float far = 1.0e6f;
};

/// Table with at least `margin_mm` of room around the swept body; error at most 5 um where the meridian is
/// smooth. Throws Error invalid_input when the profile has no cutting segment.
SweptProfile swept_profile(const ToolProfile& profile, double margin_mm);

/// The exact distance the table samples (double, libm); also the reference in tests.
double swept_distance_mm(const ToolProfile& profile, double radius_mm, double z_mm);

/// Meridian of what the cutting surface sweeps by spinning: from the axis (flat where a nipple stands) along
/// the cutting points, straight to `back_mm` behind the lowest of them, and back to the axis. Tool frame, mm.
/// Error invalid_input without a cutting surface.
ToolProfile swept_body(const ToolProfile& profile, double back_mm);

}  // namespace ream::shell
