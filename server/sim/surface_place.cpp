#include "sim/surface_place.hpp"

#include <algorithm>
#include <cmath>

namespace ream::sim {

SurfacePlace::SurfacePlace(const shell::ToolProfile& profile) {
  std::array<double, steps + 1> nearest;
  nearest.fill(2.0);
  for (size_t i = 0; i < profile.roles.size(); ++i) {
    if (profile.roles[i] != shell::SurfaceRole::cutting) continue;
    const shell::ProfilePoint &a = profile.points[i], &b = profile.points[i + 1];
    const double dr = b.radius_mm - a.radius_mm, dz = a.z_mm - b.z_mm;
    const double length = std::sqrt(dr * dr + dz * dz);
    if (length == 0.0) continue;
    const double across = std::max(0.0, dz / length);
    for (size_t k = 0; k <= steps; ++k) {
      const double off = std::abs(across - static_cast<double>(k) / steps);
      if (off >= nearest[k]) continue;
      nearest[k] = off;
      places_[k] = {0.5 * (a.radius_mm + b.radius_mm), 0.5 * (a.z_mm + b.z_mm)};
    }
  }
}

Vec3 SurfacePlace::point_mm(const Vec3& normal) const noexcept {
  const double across = std::sqrt(normal.x() * normal.x() + normal.y() * normal.y());
  const double at = std::min(across, 1.0) * steps;
  const size_t low = std::min(static_cast<size_t>(at), steps - 1);
  const double part = at - static_cast<double>(low);
  const shell::ProfilePoint &a = places_[low], &b = places_[low + 1];
  const double radius_mm = a.radius_mm + part * (b.radius_mm - a.radius_mm);
  const double z_mm = a.z_mm + part * (b.z_mm - a.z_mm);
  if (across == 0.0) return {0.0, 0.0, z_mm};
  return {radius_mm * normal.x() / across, radius_mm * normal.y() / across, z_mm};
}

}  // namespace ream::sim
