#include "score/cutting_surface.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "shell/swept_profile.hpp"

namespace ream::score {
namespace {

constexpr int sphere_segments = 720;

constexpr double table_reach_mm = 8.0;

}  // namespace

CuttingMeridian::CuttingMeridian(const shell::ToolProfile& profile) {
  std::vector<shell::ProfilePoint> points;
  for (size_t i = 0; i < profile.roles.size(); ++i) {
    if (profile.roles[i] != shell::SurfaceRole::cutting) continue;
    points.push_back(profile.points[i]);
    points.push_back(profile.points[i + 1]);
  }
  if (points.empty()) throw Error(ErrorKind::invalid_input, "the reamer has no cutting surface");
  std::stable_sort(points.begin(), points.end(),
                   [](const auto& a, const auto& b) { return a.radius_mm < b.radius_mm; });
  if (points.front().radius_mm > 0.0) points.insert(points.begin(), {0.0, points.front().z_mm});
  for (const shell::ProfilePoint& p : points) {
    if (!radius_mm_.empty() && p.radius_mm <= radius_mm_.back()) {
      behind_mm_.back() = std::min(behind_mm_.back(), -p.z_mm);
      continue;
    }
    radius_mm_.push_back(p.radius_mm);
    behind_mm_.push_back(-p.z_mm);
  }
}

CuttingMeridian CuttingMeridian::sphere(double radius_mm, double outer_mm) {
  CuttingMeridian made;
  const double end = std::asin(std::min(1.0, outer_mm / radius_mm));
  for (int i = 0; i <= sphere_segments; ++i) {
    const double angle = end * i / sphere_segments;
    made.radius_mm_.push_back(radius_mm * std::sin(angle));
    made.behind_mm_.push_back(radius_mm * (1.0 - std::cos(angle)));
  }
  return made;
}

/// The segment that holds a radius, by the number of its outer point.
size_t CuttingMeridian::segment_of(double radius_mm) const {
  const auto outer = std::upper_bound(radius_mm_.begin(), radius_mm_.end(), radius_mm);
  const auto i = static_cast<size_t>(outer - radius_mm_.begin());
  return std::clamp<size_t>(i, 1, radius_mm_.size() - 1);
}

double CuttingMeridian::behind_mm(double radius_mm) const {
  if (radius_mm_.size() < 2) return behind_mm_.empty() ? 0.0 : behind_mm_.back();
  if (radius_mm >= radius_mm_.back()) return behind_mm_.back();
  const size_t i = segment_of(radius_mm);
  const double t = (radius_mm - radius_mm_[i - 1]) / (radius_mm_[i] - radius_mm_[i - 1]);
  return behind_mm_[i - 1] + t * (behind_mm_[i] - behind_mm_[i - 1]);
}

double CuttingMeridian::slope_cosine(double radius_mm) const {
  if (radius_mm_.size() < 2) return 1.0;
  const size_t i = segment_of(radius_mm);
  const double across = radius_mm_[i] - radius_mm_[i - 1], along = behind_mm_[i] - behind_mm_[i - 1];
  return across / std::hypot(across, along);
}

SweptFront::SweptFront(const shell::ToolProfile& profile, double back_mm)
    : meridian_(shell::swept_body(profile, back_mm), table_reach_mm) {}

double SweptFront::distance_mm(const Vec3& tool_mm) const {
  return meridian_.nearest(std::hypot(tool_mm.x(), tool_mm.y()), tool_mm.z()).signed_distance_mm;
}

}  // namespace ream::score
