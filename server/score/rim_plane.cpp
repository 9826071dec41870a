#include <cmath>

#include "core/units.hpp"
#include "score/reamed_rays.hpp"
#include "score/surface_findings.hpp"

namespace ream::score {
namespace {

constexpr int directions = 360;
constexpr double inside_rim_mm = 1.0;

bool is_reamed(const AchievedFace& face, size_t ray) {
  return face.removed_mm[ray] >= reamed_mm && face.surface_mm[ray] != no_surface_mm;
}

/// The achieved face a little inside the outermost place where reamed_mm is gone; empty when there is none.
/// At that place itself the wall that a reamer leaves around it may be as well top as bottom.
/// `reamed_depth_mm`: of every ray, nothing where no bone is left under it.
std::optional<Vec3> rim_point(const RayLattice& rays, const AchievedFace& face,
                              const std::vector<double>& reamed_depth_mm, const Vec3& middle, double angle) {
  const double step = 0.5 * rays.spacing_mm();
  const double dx = std::cos(angle), dy = std::sin(angle);
  std::optional<double> last;
  double before = 0.0, edge = 0.0;
  for (double r = 0.0; r <= 2.0 * rays.reach_mm(); r += step) {
    const double removed = rays.between(reamed_depth_mm, middle.x() + r * dx, middle.y() + r * dy);
    if (removed == no_surface_mm) break;
    if (removed >= reamed_mm) {
      last = r;
      edge = r;
    } else if (last && *last == r - step && before > removed) {
      edge = r - step * (reamed_mm - removed) / (before - removed);
    }
    before = removed;
  }
  if (!last) return std::nullopt;
  const double r = edge - inside_rim_mm;
  const double x = middle.x() + r * dx, y = middle.y() + r * dy;
  const int ray = rays.nearest(x, y);
  if (ray < 0 || !is_amid_reamed(rays, face, static_cast<size_t>(ray))) return std::nullopt;
  const double z = rays.between(face.surface_mm, x, y);
  return z != no_surface_mm ? std::optional(Vec3(x, y, z)) : std::nullopt;
}

}  // namespace

bool is_amid_reamed(const RayLattice& rays, const AchievedFace& face, size_t ray) {
  if (!is_reamed(face, ray)) return false;
  constexpr int ways[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  for (const auto& way : ways) {
    const int beside = rays.neighbour(ray, way[0], way[1]);
    if (beside < 0 || !is_reamed(face, static_cast<size_t>(beside))) return false;
  }
  return true;
}

std::optional<Vec3> rim_normal(const NativeGlenoid& native, const AchievedFace& face) {
  const RayLattice& rays = native.rays();
  Vec3 middle = Vec3::Zero();
  int count = 0;
  for (size_t ray = 0; ray < rays.size(); ++ray) {
    if (!is_reamed(face, ray)) continue;
    middle += Vec3(rays.x_mm(ray), rays.y_mm(ray), 0.0);
    ++count;
  }
  if (count == 0) return std::nullopt;
  middle /= count;
  std::vector<double> reamed_depth_mm(rays.size(), 0.0);
  for (size_t ray = 0; ray < rays.size(); ++ray)
    if (face.surface_mm[ray] != no_surface_mm) reamed_depth_mm[ray] = face.removed_mm[ray];
  std::vector<Vec3> rim;
  for (int i = 0; i < directions; ++i)
    if (const auto point = rim_point(rays, face, reamed_depth_mm, middle, 2.0 * pi * i / directions))
      rim.push_back(*point);
  const auto plane = fit_plane(rim);
  if (!plane || rim.size() < directions / 2) return std::nullopt;
  const Vec3 normal = rays.world_direction(plane->normal);
  return plane->normal.z() > 0.0 ? Vec3(-normal) : normal;
}

}  // namespace ream::score
