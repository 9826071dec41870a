#include "sim/cutting_surface.hpp"

#include <algorithm>
#include <cmath>

#include "force/coefficients.hpp"

namespace ream::sim {
namespace {

using shell::ProfilePoint;

constexpr double max_element_mm = 0.1;

/// Calls `visit` with both ends of every cutting segment, from the axis outwards.
template <typename Visit>
void for_each_cutting_segment(const shell::ToolProfile& profile, const Visit& visit) {
  for (size_t i = 0; i < profile.roles.size(); ++i)
    if (profile.roles[i] == shell::SurfaceRole::cutting) visit(profile.points[i], profile.points[i + 1]);
}

/// Pieces of a straight part of the meridian from radius `from_mm` to its end, of equal length along the lip
/// as seen along the axis: there the web angle varies smoothly up to the lip's inner end.
void add_elements(force::Lip& lip, const ProfilePoint& a, const ProfilePoint& b, double from_mm) {
  const double dr = b.radius_mm - a.radius_mm, dz = a.z_mm - b.z_mm;
  const double length = std::sqrt(dr * dr + dz * dz);
  const double offset2 = lip.offset_mm * lip.offset_mm;
  const auto along_mm = [&](double r) { return std::sqrt(std::max(0.0, r * r - offset2)); };
  const double begin = along_mm(from_mm), end = along_mm(b.radius_mm);
  const int count = std::max(1, static_cast<int>(std::ceil((end - begin) / max_element_mm)));
  double inner = from_mm;
  for (int i = 1; i <= count; ++i) {
    const double along = begin + (end - begin) * i / count;
    const double outer = i == count ? b.radius_mm : std::sqrt(along * along + offset2);
    lip.elements.push_back({0.5 * (inner + outer), outer - inner, dr / length, dz / length});
    inner = outer;
  }
}

}  // namespace

force::Lip cutting_lip(const shell::ToolProfile& profile) {
  force::Lip lip;
  double cutting_radius_mm = 0.0;
  for_each_cutting_segment(profile, [&](const ProfilePoint& a, const ProfilePoint& b) {
    cutting_radius_mm = std::max({cutting_radius_mm, a.radius_mm, b.radius_mm});
  });
  lip.offset_mm = cutting_radius_mm * std::sin(force::lip_angle_rad);
  double reached_mm = lip.offset_mm;
  for_each_cutting_segment(profile, [&](const ProfilePoint& a, const ProfilePoint& b) {
    const double from_mm = std::max(reached_mm, a.radius_mm);
    if (b.radius_mm <= from_mm) return;
    add_elements(lip, a, b, from_mm);
    reached_mm = b.radius_mm;
  });
  return lip;
}

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
