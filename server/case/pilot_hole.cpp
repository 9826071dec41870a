#include <algorithm>
#include <cmath>

#include "case/case.hpp"
#include "core/error.hpp"
#include "voxel/bone_model.hpp"

namespace ream::case_ {
namespace {

/// The hole starts this far before the entry, so that no lip of bone is left over it on a concave face.
constexpr double clearance_mm = 3.0;
constexpr double entry_slack_mm = 2.0;  // bone this far from an entry still belongs to it

/// What a voxel keeps at this signed distance (mm, negative inside the hole): 0 deep inside, 255 well
/// outside, 127.5 on the border, linear over one voxel.
uint8_t kept_coverage(double distance_mm, double voxel_mm) {
  const double c = std::floor(255.0 * (0.5 + distance_mm / voxel_mm) + 0.5);
  return static_cast<uint8_t>(std::clamp(c, 0.0, 255.0));
}

/// Where the line enters and leaves the box, as parameters along `direction`; false when it misses.
bool clip_line(const Aabb& box, const Vec3& point, const Vec3& direction, double& enter, double& leave) {
  enter = -1e300, leave = 1e300;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(direction[axis]) < 1e-12) {
      if (point[axis] < box.min[axis] || point[axis] > box.max[axis]) return false;
      continue;
    }
    const double a = (box.min[axis] - point[axis]) / direction[axis];
    const double b = (box.max[axis] - point[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave;
}

/// A line through a bone, grid frame; places on it are mm from `point`.
struct LineInBone {
  LineInBone(const voxel::BoneModel& of, const Vec3& point_mm, const Vec3& direction) : bone(of) {
    if (!(direction.norm() > 1e-12))
      throw Error(ErrorKind::invalid_input, "the axis direction must not be zero");
    const Pose grid_from_world = bone.grid.world_from_grid.inverse();
    point = grid_from_world.point(point_mm);
    along = grid_from_world.direction(direction).normalized();
    step = 0.25 * bone.grid.min_spacing_mm();
    if (!clip_line(bone.grid.bounds_mm().grown(step), point, along, enter, leave)) enter = 0.0, leave = -1.0;
  }

  bool inside(double s) const { return voxel::coverage_at(bone, point + s * along) >= 127.5; }

  /// Where the line first is inside (or outside) the bone between two places: the last point before the
  /// change is narrowed down by halving.
  std::optional<double> first_change(double from, double to, bool to_inside) const {
    double before = from;
    for (double s = from; s <= to; s += step) {
      if (inside(s) != to_inside) {
        before = s;
        continue;
      }
      double after = s;
      for (int halving = 0; halving < 30; ++halving) {
        const double middle = 0.5 * (before + after);
        (inside(middle) == to_inside ? after : before) = middle;
      }
      return after;
    }
    return std::nullopt;
  }

  const voxel::BoneModel& bone;
  Vec3 point, along;
  double step = 1.0, enter = 0.0, leave = -1.0;
};

}  // namespace

void cut_pilot_hole(voxel::BoneModel& bone, const Plan& plan) {
  if (!plan.pilot_hole) return;
  const Pose grid_from_world = bone.grid.world_from_grid.inverse();
  const Vec3 entry = grid_from_world.point(plan.entry_mm);
  const Vec3 axis = grid_from_world.direction(plan.axis_direction);
  const double radius = 0.5 * plan.pilot_hole->diameter_mm, depth = plan.pilot_hole->depth_mm;
  const double voxel_mm = bone.grid.min_spacing_mm();

  Aabb box;
  box.include(entry - clearance_mm * axis);
  box.include(entry + depth * axis);
  box = box.grown(radius + voxel_mm).intersection(bone.grid.bounds_mm());
  if (box.empty()) return;
  const Vec3i low = bone.grid.voxel_at(box.min).cwiseMax(0);
  const Vec3i high = bone.grid.voxel_at(box.max).cwiseMin((bone.grid.dims.array() - 1).matrix());
  for (int w = low.z(); w <= high.z(); ++w)
    for (int v = low.y(); v <= high.y(); ++v)
      for (int u = low.x(); u <= high.x(); ++u) {
        const Vec3 from_entry = bone.grid.centre_mm({u, v, w}) - entry;
        const double along = from_entry.dot(axis);
        const double across = std::sqrt(std::max(0.0, from_entry.squaredNorm() - along * along));
        const double distance = std::max({across - radius, along - depth, -clearance_mm - along});
        uint8_t& coverage = bone.coverage[bone.grid.index(u, v, w)];
        coverage = std::min(coverage, kept_coverage(distance, voxel_mm));
      }
}

std::optional<Vec3> surface_along(const voxel::BoneModel& bone, const Vec3& point_mm, const Vec3& direction) {
  const LineInBone line(bone, point_mm, direction);
  const auto first = line.first_change(line.enter, line.leave, true);
  if (!first) return std::nullopt;
  return bone.grid.world_from_grid.point(line.point + *first * line.along);
}

std::optional<double> bone_depth_along(const voxel::BoneModel& bone, const Vec3& entry_mm,
                                       const Vec3& direction) {
  const LineInBone line(bone, entry_mm, direction);
  const auto first =
      line.first_change(std::max(line.enter, -entry_slack_mm), std::min(line.leave, entry_slack_mm), true);
  if (!first) return std::nullopt;
  return line.first_change(*first + line.step, line.leave, false).value_or(line.leave);
}

}  // namespace ream::case_
