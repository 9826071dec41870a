#include "score/bone_surface.hpp"

#include <algorithm>
#include <cmath>

#include "voxel/bone_model.hpp"

namespace ream::score {
namespace {

constexpr double surface_level = 127.5, whole_level = 255.0;
constexpr double nearly_none = 2.0, nearly_whole = 253.0;
constexpr int halvings = 14, samples_a_voxel = 4;
constexpr double reach_voxels = 2.0;

}  // namespace

SurfaceFinder::SurfaceFinder(const CoverageView& bone)
    : bone_(bone),
      grid_from_world_(bone.grid.world_from_grid.inverse()),
      step_mm_(0.5 * bone.grid.min_spacing_mm()),
      reach_mm_(reach_voxels * bone.grid.spacing_mm.maxCoeff()) {}

SurfaceFinder::Line SurfaceFinder::line_of(const Vec3& point_mm, const Vec3& direction) const {
  return {grid_from_world_.point(point_mm), grid_from_world_.direction(direction)};
}

double SurfaceFinder::at(const Line& line, double s_mm) const {
  return voxel::coverage_at(bone_.grid, bone_.coverage, line.point_mm + s_mm * line.direction);
}

double SurfaceFinder::coverage_at(const Vec3& world_mm) const {
  return voxel::coverage_at(bone_.grid, bone_.coverage, grid_from_world_.point(world_mm));
}

std::optional<std::pair<double, double>> SurfaceFinder::span_in_grid(const Vec3& point_mm,
                                                                     const Vec3& direction) const {
  const Line line = line_of(point_mm, direction);
  const Aabb box = bone_.grid.bounds_mm().grown(step_mm_);
  double enter = -1e300, leave = 1e300;
  for (int axis = 0; axis < 3; ++axis) {
    const double p = line.point_mm[axis], d = line.direction[axis];
    if (std::abs(d) < 1e-12) {
      if (p < box.min[axis] || p > box.max[axis]) return std::nullopt;
      continue;
    }
    const double a = (box.min[axis] - p) / d, b = (box.max[axis] - p) / d;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (enter >= leave) return std::nullopt;
  return std::pair(enter, leave);
}

/// Where the level lies between a place outside bone and one inside it, by halving.
double SurfaceFinder::level_between(const Line& line, double air_mm, double bone_mm) const {
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (air_mm + bone_mm);
    (at(line, middle) >= surface_level ? bone_mm : air_mm) = middle;
  }
  return 0.5 * (air_mm + bone_mm);
}

int SurfaceFinder::voxel_at(const Line& line, double s_mm) const {
  const Vec3i o = bone_.grid.voxel_at(line.point_mm + s_mm * line.direction);
  return bone_.grid.contains(o) ? bone_.coverage[bone_.grid.index(o)] : 0;
}

double SurfaceFinder::refined(const Line& line, double level_mm) const {
  if (at(line, level_mm - reach_mm_) > nearly_none) return level_mm;
  if (at(line, level_mm + reach_mm_) < nearly_whole) return level_mm;
  constexpr int count = static_cast<int>(2.0 * reach_voxels) * samples_a_voxel;
  const double step = 2.0 * reach_mm_ / count;
  double sum = 0.5 * whole_level;  // the two ends, each half
  for (int i = 1; i < count; ++i) sum += at(line, level_mm - reach_mm_ + i * step);
  return level_mm + reach_mm_ - sum / whole_level * step;
}

std::optional<double> SurfaceFinder::into_bone(const Vec3& point_mm, const Vec3& direction, double from_mm,
                                               double to_mm) const {
  const Line line = line_of(point_mm, direction);
  double before = from_mm;
  for (double s = from_mm; s <= to_mm; s += step_mm_) {
    // One byte says whether eight are worth reading.
    if (voxel_at(line, s) != 0 && at(line, s) >= surface_level)
      return s > before ? refined(line, level_between(line, before, s)) : s;
    before = s;
  }
  return std::nullopt;
}

std::optional<double> SurfaceFinder::out_of_bone(const Vec3& point_mm, const Vec3& direction, double from_mm,
                                                 double to_mm) const {
  const Line line = line_of(point_mm, direction);
  // Finely while a thin edge may end, then a byte a voxel.
  for (double s = from_mm; s <= std::min(to_mm, from_mm + reach_mm_); s += step_mm_)
    if (at(line, s) < surface_level) return s > from_mm ? level_between(line, s, s - step_mm_) : s;
  const double voxel_mm = 2.0 * step_mm_;
  for (double s = from_mm + reach_mm_; s <= to_mm; s += voxel_mm) {
    if (voxel_at(line, s) > surface_level) continue;
    const double bone = std::max(from_mm, s - 2.0 * voxel_mm), air = s + voxel_mm;
    // Along a wall the line goes out slowly, and not where one byte says so.
    for (double fine = bone + step_mm_; fine <= air + 4.0 * voxel_mm; fine += step_mm_)
      if (at(line, fine) < surface_level) return level_between(line, fine, fine - step_mm_);
    return s;
  }
  return std::nullopt;
}

double SurfaceFinder::depth(const RayLattice& rays, size_t ray, double from_mm) const {
  if (from_mm == no_surface_mm) return no_surface_mm;
  const Vec3 along = rays.world_direction(Vec3::UnitZ()), start = rays.world(ray, 0.0);
  const auto span = span_in_grid(start, along);
  if (!span) return no_surface_mm;
  return into_bone(start, along, std::max(span->first, from_mm - reach_mm_), span->second)
      .value_or(no_surface_mm);
}

std::vector<double> SurfaceFinder::depths(const RayLattice& rays, const std::vector<double>& from_mm) const {
  std::vector<double> found;
  for (size_t ray = 0; ray < rays.size(); ++ray) found.push_back(depth(rays, ray, from_mm[ray]));
  return found;
}

std::vector<double> SurfaceFinder::depths(const RayLattice& rays) const {
  return depths(rays, std::vector<double>(rays.size(), -1e300));
}

}  // namespace ream::score
