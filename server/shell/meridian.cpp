#include "shell/meridian.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ream::shell {
namespace {

constexpr double coincident_mm = 1e-9;
constexpr int max_grid_cells_per_side = 64;

struct Direction {
  double radial = 0, z = 1;
};

Direction unit(double radial, double z) {
  const double length = std::hypot(radial, z);
  return {radial / length, z / length};
}

Direction segment_normal(const ToolProfile& profile, size_t segment) {
  const ProfilePoint &a = profile.points[segment], &b = profile.points[segment + 1];
  return unit(a.z_mm - b.z_mm, b.radius_mm - a.radius_mm);
}

/// Bisects the normals of the two segments that meet in a corner; on the axis the other one is the mirror
/// image.
Direction corner_normal(const ToolProfile& profile, size_t corner) {
  if (corner == 0) return {0.0, segment_normal(profile, 0).z >= 0.0 ? 1.0 : -1.0};
  if (corner + 1 == profile.points.size())
    return {0.0, segment_normal(profile, corner - 1).z >= 0.0 ? 1.0 : -1.0};
  const Direction a = segment_normal(profile, corner - 1), b = segment_normal(profile, corner);
  if (a.radial * b.radial + a.z * b.z < -1.0 + 1e-12) return a;
  return unit(a.radial + b.radial, a.z + b.z);
}

double squared_distance(const ToolProfile& profile, size_t segment, double radius_mm, double z_mm,
                        double& along) {
  const ProfilePoint &a = profile.points[segment], &b = profile.points[segment + 1];
  const double dr = b.radius_mm - a.radius_mm, dz = b.z_mm - a.z_mm;
  const double pr = radius_mm - a.radius_mm, pz = z_mm - a.z_mm;
  along = std::clamp((pr * dr + pz * dz) / (dr * dr + dz * dz), 0.0, 1.0);
  const double er = pr - along * dr, ez = pz - along * dz;
  return er * er + ez * ez;
}

struct Nearest {
  size_t segment = 0;
  double squared_distance_mm2 = std::numeric_limits<double>::max(), along = 0.0;

  void consider(const ToolProfile& profile, size_t s, double radius_mm, double z_mm) {
    double s_along = 0.0;
    const double d2 = squared_distance(profile, s, radius_mm, z_mm, s_along);
    if (d2 < squared_distance_mm2) *this = {s, d2, s_along};
  }
};

MeridianHit hit_at(const ToolProfile& profile, const Nearest& nearest, double radius_mm, double z_mm) {
  const double distance = std::sqrt(nearest.squared_distance_mm2);
  const bool at_corner = nearest.along <= 0.0 || nearest.along >= 1.0;
  const size_t corner = nearest.along <= 0.0 ? nearest.segment : nearest.segment + 1;
  Direction normal = at_corner ? corner_normal(profile, corner) : segment_normal(profile, nearest.segment);
  const ProfilePoint& from = profile.points[at_corner ? corner : nearest.segment];
  const double pr = radius_mm - from.radius_mm, pz = z_mm - from.z_mm;
  const double sign = pr * normal.radial + pz * normal.z < 0.0 ? -1.0 : 1.0;
  if (at_corner && distance > coincident_mm) normal = {sign * pr / distance, sign * pz / distance};
  return {nearest.segment, sign * distance, normal.radial, normal.z};
}

double distance_from_chord(const ProfilePoint& p, const ProfilePoint& a, const ProfilePoint& b) {
  const double dr = b.radius_mm - a.radius_mm, dz = b.z_mm - a.z_mm;
  const double length2 = dr * dr + dz * dz;
  double along = 0.0;
  if (length2 > 0.0)
    along = std::clamp(((p.radius_mm - a.radius_mm) * dr + (p.z_mm - a.z_mm) * dz) / length2, 0.0, 1.0);
  return std::hypot(p.radius_mm - a.radius_mm - along * dr, p.z_mm - a.z_mm - along * dz);
}

/// Marks the corners between `first` and `last` that must stay.
void keep_corners(const std::vector<ProfilePoint>& points, size_t first, size_t last, double tolerance_mm,
                  std::vector<bool>& keep) {
  std::vector<std::pair<size_t, size_t>> open{{first, last}};
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    size_t farthest = begin;
    double distance = tolerance_mm;
    for (size_t i = begin + 1; i < end; ++i) {
      const double d = distance_from_chord(points[i], points[begin], points[end]);
      if (d > distance) {
        distance = d;
        farthest = i;
      }
    }
    if (farthest == begin) continue;
    keep[farthest] = true;
    open.emplace_back(begin, farthest);
    open.emplace_back(farthest, end);
  }
}

}  // namespace

MeridianHit nearest_on_profile(const ToolProfile& profile, double radius_mm, double z_mm) {
  Nearest best;
  for (size_t s = 0; s < profile.roles.size(); ++s) best.consider(profile, s, radius_mm, z_mm);
  return hit_at(profile, best, radius_mm, z_mm);
}

Meridian::Meridian(ToolProfile profile, double reach_mm) : profile_(std::move(profile)) {
  min_z_mm_ = profile_.min_z_mm() - reach_mm;
  const double height = profile_.max_z_mm() + reach_mm - min_z_mm_;
  const double width = profile_.max_radius_mm() + reach_mm;
  cell_mm_ = std::max(height, width) / max_grid_cells_per_side;
  radius_cells_ = static_cast<int>(std::ceil(width / cell_mm_));
  z_cells_ = static_cast<int>(std::ceil(height / cell_mm_));
  first_candidate_.push_back(0);
  for (int k = 0; k < z_cells_; ++k)
    for (int i = 0; i < radius_cells_; ++i) {
      list_candidates((i + 0.5) * cell_mm_, min_z_mm_ + (k + 0.5) * cell_mm_, std::sqrt(0.5) * cell_mm_);
      first_candidate_.push_back(static_cast<uint32_t>(candidates_.size()));
    }
}

void Meridian::list_candidates(double cell_radius_mm, double cell_z_mm, double half_diagonal_mm) {
  std::vector<double> distances(profile_.roles.size());
  double nearest_mm = std::numeric_limits<double>::max(), along = 0.0;
  for (size_t s = 0; s < distances.size(); ++s) {
    distances[s] = std::sqrt(squared_distance(profile_, s, cell_radius_mm, cell_z_mm, along));
    nearest_mm = std::min(nearest_mm, distances[s]);
  }
  const double limit_mm = nearest_mm + 2.0 * half_diagonal_mm + 1e-6;
  for (size_t s = 0; s < distances.size(); ++s)
    if (distances[s] <= limit_mm) candidates_.push_back(static_cast<uint32_t>(s));
}

MeridianHit Meridian::nearest(double radius_mm, double z_mm) const {
  const double i = std::floor(radius_mm / cell_mm_), k = std::floor((z_mm - min_z_mm_) / cell_mm_);
  if (!(i >= 0 && k >= 0 && i < radius_cells_ && k < z_cells_))
    return nearest_on_profile(profile_, radius_mm, z_mm);
  const auto cell = static_cast<size_t>(i) + static_cast<size_t>(k) * static_cast<size_t>(radius_cells_);
  Nearest best;
  for (uint32_t c = first_candidate_[cell]; c < first_candidate_[cell + 1]; ++c)
    best.consider(profile_, candidates_[c], radius_mm, z_mm);
  return hit_at(profile_, best, radius_mm, z_mm);
}

ToolProfile simplified(const ToolProfile& profile, double tolerance_mm) {
  const size_t count = profile.points.size();
  std::vector<bool> keep(count, false);
  size_t first = 0;
  for (size_t i = 1; i < count; ++i) {
    const bool boundary = i + 1 == count || profile.roles[i] != profile.roles[i - 1];
    if (!boundary) continue;
    keep[first] = keep[i] = true;
    keep_corners(profile.points, first, i, tolerance_mm, keep);
    first = i;
  }
  ToolProfile out;
  for (size_t i = 0; i < count; ++i) {
    if (!keep[i]) continue;
    out.points.push_back(profile.points[i]);
    if (i + 1 < count) out.roles.push_back(profile.roles[i]);
  }
  return out;
}

}  // namespace ream::shell
