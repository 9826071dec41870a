#include "shell/tool_profile_from_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "shell/meridian.hpp"
#include "shell/mesh_envelope.hpp"

namespace ream::shell {
namespace {

constexpr int radius_samples = 1000;
constexpr double step_height_mm = 0.2;  ///< between neighbouring samples: the edge is then found exactly
constexpr double edge_accuracy_mm = 5e-4;
constexpr double nipple_slope = 3.0;  ///< z over radius; an ellipse a, b near its apex stays far below
constexpr double nipple_reach = 0.4;  ///< of the largest radius
constexpr double least_nipple_mm = 1.0;
constexpr double wall_slope = 5.7;      ///< 80 degrees
constexpr double wall_width_mm = 0.01;  ///< scatter of a faceted side wall
constexpr double sheet_mm = 0.05, sheet_back_mm = 1.0;
constexpr double simplification_mm = 0.005;

using Heights = std::vector<ProfilePoint>;

/// Adds the two sides of a step between the last point and (radius, z).
template <typename HeightAt>
void add_edge(Heights& heights, const ProfilePoint& next, const HeightAt& height_at) {
  ProfilePoint low = heights.back(), high = next;
  while (high.radius_mm - low.radius_mm > edge_accuracy_mm) {
    const double radius = 0.5 * (low.radius_mm + high.radius_mm), z = height_at(radius);
    if (!std::isfinite(z)) break;
    (std::abs(z - low.z_mm) < std::abs(z - high.z_mm) ? low : high) = {radius, z};
  }
  if (low.radius_mm > heights.back().radius_mm) heights.push_back(low);
  if (high.radius_mm < next.radius_mm) heights.push_back(high);
}

/// The envelope from the axis to the rim; gaps (a hole along the axis) are bridged at the height of their
/// outer border.
template <typename HeightAt>
Heights sample(double max_radius_mm, const HeightAt& height_at) {
  Heights heights;
  const double last_radius = max_radius_mm * (1.0 - 1e-7);
  for (int i = 0; i <= radius_samples; ++i) {
    const ProfilePoint p{last_radius * i / radius_samples, height_at(last_radius * i / radius_samples)};
    if (!std::isfinite(p.z_mm)) continue;
    if (heights.empty() && p.radius_mm > 0.0) heights.push_back({0.0, p.z_mm});
    if (!heights.empty() && std::abs(p.z_mm - heights.back().z_mm) > step_height_mm)
      add_edge(heights, p, height_at);
    heights.push_back(p);
  }
  return heights;
}

double slope_after(const Heights& heights, size_t i) {
  return (heights[i].z_mm - heights[i + 1].z_mm) / (heights[i + 1].radius_mm - heights[i].radius_mm);
}

/// Index of the first point of the cutting surface: 0 without a nipple.
size_t nipple_end(const Heights& front, double max_radius_mm) {
  double fall = 0.0;
  size_t end = 0;
  for (size_t i = 0; i + 1 < front.size() && front[i].radius_mm < nipple_reach * max_radius_mm; ++i)
    if (slope_after(front, i) > nipple_slope) {
      fall += front[i].z_mm - front[i + 1].z_mm;
      end = i + 1;
    }
  return fall > least_nipple_mm ? end : 0;
}

/// Index of the last point of the cutting surface; behind it the front falls as a side wall.
size_t cutting_end(const Heights& front, double max_radius_mm) {
  size_t end = front.size() - 1;
  while (end > 0 && front[end - 1].radius_mm > max_radius_mm - wall_width_mm &&
         slope_after(front, end - 1) > wall_slope)
    --end;
  return end;
}

/// Height at the axis of z = apex + k r^2 fitted to the innermost part of the cutting surface.
double apex_of(const Heights& front, size_t begin, size_t end) {
  if (begin == 0) return front[0].z_mm;
  const double reach =
      front[begin].radius_mm + std::max(1.0, 0.15 * (front[end].radius_mm - front[begin].radius_mm));
  double n = 0, sx = 0, sz = 0, sxx = 0, sxz = 0;
  for (size_t i = begin; i <= end && front[i].radius_mm <= reach; ++i) {
    const double x = front[i].radius_mm * front[i].radius_mm, z = front[i].z_mm;
    n += 1;
    sx += x;
    sz += z;
    sxx += x * x;
    sxz += x * z;
  }
  const double spread = n * sxx - sx * sx;
  return spread > 0.0 ? (sz * sxx - sx * sxz) / spread : front[begin].z_mm;
}

void give_a_sheet_its_back(const Heights& front, Heights& back) {
  double thickest = 0.0, lowest = front[0].z_mm;
  for (const ProfilePoint& p : front) lowest = std::min(lowest, p.z_mm);
  if (front.size() != back.size()) return;
  for (size_t i = 0; i < front.size(); ++i) thickest = std::max(thickest, front[i].z_mm - back[i].z_mm);
  if (thickest < sheet_mm)
    for (ProfilePoint& p : back) p.z_mm = lowest - sheet_back_mm;
}

void add_point(ToolProfile& profile, const ProfilePoint& p, double apex_z_mm, SurfaceRole role) {
  const ProfilePoint moved{p.radius_mm, p.z_mm - apex_z_mm};
  if (!profile.points.empty()) {
    const ProfilePoint& last = profile.points.back();
    if (std::hypot(moved.radius_mm - last.radius_mm, moved.z_mm - last.z_mm) < 1e-6) return;
    profile.roles.push_back(role);
  }
  profile.points.push_back(moved);
}

}  // namespace

MeasuredProfile tool_profile_from_mesh(const TriangleMesh& mesh, const std::string& name) {
  const MeshEnvelope envelope(mesh);
  const double max_radius = envelope.max_radius_mm();
  if (!(max_radius > 0.0) || envelope.min_radius_mm() > 0.5 * max_radius)
    throw Error(
        ErrorKind::invalid_input,
        "mesh " + name + ": its surface does not reach the tool axis; check --tool-axis X,Y,Z,DX,DY,DZ");
  const Heights front = sample(max_radius, [&](double r) { return envelope.top_mm(r); });
  Heights back = sample(max_radius, [&](double r) { return envelope.bottom_mm(r); });
  give_a_sheet_its_back(front, back);

  const size_t begin = nipple_end(front, max_radius), end = cutting_end(front, max_radius);
  MeasuredProfile measured;
  measured.apex_z_mm = apex_of(front, begin, end);
  ToolProfile& profile = measured.profile;
  for (size_t i = 0; i < front.size(); ++i)
    add_point(profile, front[i], measured.apex_z_mm,
              i <= begin ? SurfaceRole::guiding
              : i <= end ? SurfaceRole::cutting
                         : SurfaceRole::smooth);
  for (size_t i = back.size(); i-- > 0;) add_point(profile, back[i], measured.apex_z_mm, SurfaceRole::smooth);
  profile = simplified(profile, simplification_mm);
  return measured;
}

}  // namespace ream::shell
