#include "score/native_glenoid.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace ream::score {
namespace {

constexpr double steepest = 1.7320508075688772;  // tan 60 degrees
constexpr double deepest_exit_mm = 45.0;
constexpr double search_for_middle_mm = 5.0;
// Outer cortex is kept as far as any peg, keel or reamer may reach.
constexpr double cortex_across_mm = 35.0, cortex_before_mm = 12.0, cortex_behind_mm = 45.0;
// A point this near to the face's own depth belongs to the face.
constexpr double face_thickness_mm = 2.0;

RayLattice lattice_for(const Task& task, double reach_mm, double spacing_mm) {
  if (task.plan)
    return {task.plan->entry_mm, task.plan->axis_direction.normalized(), task.anatomy.side, reach_mm,
            spacing_mm};
  if (task.anatomy.glenoid)
    return {task.anatomy.glenoid->centre_mm, -task.anatomy.glenoid->lateral, task.anatomy.side, reach_mm,
            spacing_mm};
  throw Error(ErrorKind::invalid_input,
              "a case without plan and glenoid frame says nothing to measure a session against");
}

}  // namespace

NativeGlenoid::NativeGlenoid(Task task, const voxel::BoneModel& native)
    : task_(std::move(task)),
      reamer_(task_.reamer),
      rays_(lattice_for(task_, reamer_.outer_mm() + beyond_reamer_mm, spacing_mm)) {
  find_depths(native);
  face_ = connected_to_middle();
  // Nearer to the wall than a voxel, what is interpolated of the face is rounded off.
  const double edge_mm = std::max(spacing_mm, native.grid.spacing_mm.maxCoeff());
  for (double left_out_mm = 0.0; left_out_mm < edge_mm; left_out_mm += spacing_mm)
    face_ = without_edge(face_);
  find_outer_cortex(native);
  leave_out_pilot_hole(native.grid.spacing_mm.maxCoeff());
  plate_ = find_plate(native, rays_, subchondral_mm_, face_);
}

void NativeGlenoid::find_depths(const voxel::BoneModel& native) {
  const SurfaceFinder finder({native.grid, native.coverage.data()});
  surface_mm_ = finder.depths(rays_);
  exit_mm_.assign(rays_.size(), no_surface_mm);
  subchondral_mm_ = surface_mm_;
  const Vec3 along = rays_.world_direction(Vec3::UnitZ());
  const Pose grid_from_world = native.grid.world_from_grid.inverse();
  const double voxel_mm = native.grid.min_spacing_mm();
  for (size_t ray = 0; ray < rays_.size(); ++ray) {
    if (surface_mm_[ray] == no_surface_mm) continue;
    const double inside_mm = surface_mm_[ray] + 0.25 * voxel_mm;
    exit_mm_[ray] = finder.out_of_bone(rays_.world(ray, 0.0), along, inside_mm, inside_mm + deepest_exit_mm)
                        .value_or(no_surface_mm);
    // Through what is cartilage, voxel by voxel.
    for (double s = inside_mm; s < std::min(exit_mm_[ray], inside_mm + deepest_exit_mm);
         s += 0.25 * voxel_mm) {
      const Vec3i o = native.grid.voxel_at(grid_from_world.point(rays_.world(ray, s)));
      if (!native.grid.contains(o) || native.density[native.grid.index(o)] != voxel::cartilage_code) break;
      subchondral_mm_[ray] = s;
    }
  }
}

std::vector<uint8_t> NativeGlenoid::connected_to_middle() const {
  std::vector<uint8_t> reached(rays_.size(), 0);
  double nearest_mm = search_for_middle_mm;
  size_t middle = rays_.size();
  for (size_t ray = 0; ray < rays_.size(); ++ray) {
    const double away_mm = std::hypot(rays_.x_mm(ray), rays_.y_mm(ray));
    if (surface_mm_[ray] == no_surface_mm || away_mm >= nearest_mm) continue;
    nearest_mm = away_mm;
    middle = ray;
  }
  if (middle == rays_.size()) return reached;
  std::vector<size_t> open{middle};
  reached[middle] = 1;
  constexpr int ways[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  while (!open.empty()) {
    const size_t ray = open.back();
    open.pop_back();
    for (const auto& way : ways) {
      const int found = rays_.neighbour(ray, way[0], way[1]);
      if (found < 0) continue;
      const auto beside = static_cast<size_t>(found);
      if (reached[beside] || surface_mm_[beside] == no_surface_mm) continue;
      if (std::abs(surface_mm_[beside] - surface_mm_[ray]) > steepest * rays_.spacing_mm()) continue;
      reached[beside] = 1;
      open.push_back(beside);
    }
  }
  return reached;
}

/// Rays along the edge graze the wall beside the face, and where they leave the bone is anybody's guess.
std::vector<uint8_t> NativeGlenoid::without_edge(const std::vector<uint8_t>& face) const {
  std::vector<uint8_t> inner(face);
  constexpr int ways[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  for (size_t ray = 0; ray < rays_.size(); ++ray)
    for (const auto& way : ways) {
      const int beside = rays_.neighbour(ray, way[0], way[1]);
      if (beside < 0 || !face[static_cast<size_t>(beside)]) inner[ray] = 0;
    }
  return inner;
}

void NativeGlenoid::leave_out_pilot_hole(double margin_mm) {
  if (!task_.plan || !task_.plan->pilot_hole) return;
  const double radius_mm = 0.5 * task_.plan->pilot_hole->diameter_mm + margin_mm;
  for (size_t ray = 0; ray < rays_.size(); ++ray)
    if (std::hypot(rays_.x_mm(ray), rays_.y_mm(ray)) < radius_mm) face_[ray] = 0;
}

void NativeGlenoid::find_outer_cortex(const voxel::BoneModel& native) {
  Aabb box;
  for (int corner = 0; corner < 8; ++corner)
    box.include(rays_.world(Vec3((corner & 1) ? cortex_across_mm : -cortex_across_mm,
                                 (corner & 2) ? cortex_across_mm : -cortex_across_mm,
                                 (corner & 4) ? cortex_behind_mm : -cortex_before_mm)));
  const auto is_face = [&](const Vec3& world_mm) {
    const Vec3 p = rays_.in_lattice(world_mm);
    const int ray = rays_.nearest(p.x(), p.y());
    return ray >= 0 && face_[static_cast<size_t>(ray)] &&
           std::abs(p.z() - surface_mm_[static_cast<size_t>(ray)]) < face_thickness_mm;
  };
  outer_cortex_ = std::make_shared<const OuterCortex>(native, box, is_face);
}

NativeGlenoid NativeGlenoid::thinned(int stride) const {
  NativeGlenoid thin;
  std::vector<size_t> kept;
  thin.task_ = task_;
  thin.reamer_ = reamer_;
  thin.rays_ = rays_.thinned(stride, kept);
  const auto pick = [&](const auto& all) {
    std::remove_cvref_t<decltype(all)> some;
    for (const size_t ray : kept) some.push_back(all[ray]);
    return some;
  };
  thin.surface_mm_ = pick(surface_mm_);
  thin.subchondral_mm_ = pick(subchondral_mm_);
  thin.exit_mm_ = pick(exit_mm_);
  thin.face_ = pick(face_);
  thin.plate_ = {plate_.found_by_density, plate_.median_mm, pick(plate_.thickness_mm)};
  thin.outer_cortex_ = outer_cortex_;
  return thin;
}

}  // namespace ream::score
