#include "score/native_glenoid.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "voxel/solid_cells.hpp"

namespace ream::score {
namespace {

constexpr double surface_level = 127.5;

Vec3i cell_of(const Vec3& offset_mm, double cell_mm) {
  return (offset_mm / cell_mm).array().floor().matrix().cast<int>();
}

enum class Filling : uint8_t { empty, mixed, full };

std::vector<Filling> fillings_of(const voxel::BoneModel& bone) {
  std::vector<Filling> fillings(bone.grid.brick_count());
  for (uint32_t brick = 0; brick < fillings.size(); ++brick) {
    const uint16_t word = voxel::SolidCells::word_of(bone.coverage.data() + bone.grid.brick_base(brick));
    fillings[brick] = (word & 0xff) == 0    ? Filling::empty
                      : (word >> 8) == 0xff ? Filling::full
                                            : Filling::mixed;
  }
  return fillings;
}

/// Whether no surface can lie in a brick or on its sides.
bool has_no_surface(const voxel::VoxelGrid& grid, const std::vector<Filling>& fillings, const Vec3i& brick) {
  const Filling own = fillings[grid.brick_index(brick)];
  if (own != Filling::full) return own == Filling::empty;
  for (int axis = 0; axis < 3; ++axis)
    for (const int way : {-1, 1}) {
      Vec3i beside = brick;
      beside[axis] += way;
      const bool outside = beside[axis] < 0 || beside[axis] >= grid.brick_dims()[axis];
      if (outside || fillings[grid.brick_index(beside)] != Filling::full) return false;
    }
  return true;
}

/// Calls `found(point)` where the coverage crosses its middle between a solid voxel of a brick and one beside
/// it; grid frame.
template <typename Found>
void for_each_crossing(const voxel::BoneModel& bone, const Vec3i& brick, Found found) {
  const voxel::VoxelGrid& grid = bone.grid;
  const auto coverage_of = [&](const Vec3i& o) {
    return grid.contains(o) ? bone.coverage[grid.index(o)] : 0;
  };
  for (int i = 0; i < voxel::brick_voxels; ++i) {
    const Vec3i o = brick * voxel::brick_edge + Vec3i(i % 8, i / 8 % 8, i / 64);
    const int here = coverage_of(o);
    if (here < voxel::solid_coverage) continue;
    for (int axis = 0; axis < 3; ++axis)
      for (const int way : {-1, 1}) {
        Vec3i beside = o;
        beside[axis] += way;
        const int there = coverage_of(beside);
        if (there >= voxel::solid_coverage) continue;
        Vec3 point = grid.centre_mm(o);
        point[axis] += way * grid.spacing_mm[axis] * (here - surface_level) / (here - there);
        found(point);
      }
  }
}

constexpr double surface_layer_mm = 1.5, spongy_from_mm = 4.0, spongy_to_mm = 6.0, thickest_mm = 5.0;
constexpr double min_contrast_g_cc = 0.25;
constexpr double enough_share = 0.25;  // of the rays must show an end

/// Density of bone along a ray, sampled from the subchondral surface on.
class DensityProbe {
 public:
  DensityProbe(const voxel::BoneModel& bone, const RayLattice& rays)
      : bone_(bone), rays_(rays), grid_from_world_(bone.grid.world_from_grid.inverse()) {}

  /// Trilinear among voxels that are bone; empty where there is none.
  std::optional<double> at(size_t ray, double depth_mm) const {
    const Vec3 point = grid_from_world_.point(rays_.world(ray, depth_mm));
    const Vec3 position = (point.array() / bone_.grid.spacing_mm.array() - 0.5).matrix();
    const Vec3 low = position.array().floor().matrix(), t = position - low;
    const Vec3i base = low.cast<int>();
    double sum = 0.0, weights = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3i o(base.x() + (corner & 1), base.y() + ((corner >> 1) & 1), base.z() + (corner >> 2));
      if (!bone_.grid.contains(o)) continue;
      const size_t i = bone_.grid.index(o);
      if (bone_.coverage[i] == 0 || bone_.density[i] == voxel::cartilage_code) continue;
      const double weight = ((corner & 1) ? t.x() : 1.0 - t.x()) * ((corner & 2) ? t.y() : 1.0 - t.y()) *
                            ((corner & 4) ? t.z() : 1.0 - t.z());
      sum += weight * voxel::density_g_cc(bone_.density[i]);
      weights += weight;
    }
    return weights > 1e-6 ? std::optional(sum / weights) : std::nullopt;
  }

 private:
  const voxel::BoneModel& bone_;
  const RayLattice& rays_;
  Pose grid_from_world_;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Where density falls below `limit` for the first time after having been above it.
std::optional<double> end_of_plate(const DensityProbe& probe, size_t ray, double from_mm, double limit,
                                   double step_mm) {
  bool dense = false;
  double before = 0.0;
  for (double s = 0.5 * step_mm; s <= thickest_mm; s += step_mm) {
    const auto density = probe.at(ray, from_mm + s);
    if (!density) return std::nullopt;
    if (dense && *density < limit) return s - step_mm * (limit - *density) / (before - *density);
    if (!dense && s > surface_layer_mm) return std::nullopt;
    dense = dense || *density >= limit;
    before = *density;
  }
  return std::nullopt;
}

/// Medians over the face: the densest within the surface layer, and the mean further below.
std::optional<double> limit_density(const DensityProbe& probe, const std::vector<double>& subchondral_mm,
                                    const std::vector<uint8_t>& face, double step_mm) {
  std::vector<double> dense, spongy;
  for (size_t ray = 0; ray < face.size(); ++ray) {
    if (!face[ray]) continue;
    double densest = -1.0, sum = 0.0;
    int count = 0;
    for (double s = 0.5 * step_mm; s <= surface_layer_mm; s += step_mm)
      densest = std::max(densest, probe.at(ray, subchondral_mm[ray] + s).value_or(-1.0));
    for (double s = spongy_from_mm; s <= spongy_to_mm; s += step_mm)
      if (const auto density = probe.at(ray, subchondral_mm[ray] + s)) sum += *density, ++count;
    if (densest >= 0.0) dense.push_back(densest);
    if (count > 0) spongy.push_back(sum / count);
  }
  if (dense.empty() || spongy.empty()) return std::nullopt;
  const double above = median(std::move(dense)), below = median(std::move(spongy));
  return above - below >= min_contrast_g_cc ? std::optional(0.5 * (above + below)) : std::nullopt;
}

constexpr double steepest = 1.7320508075688772;  // tan 60 degrees
constexpr double deepest_exit_mm = 45.0;
constexpr double search_for_middle_mm = 5.0;
// Outer cortex is kept as far as any peg, keel or reamer may reach.
constexpr double cortex_across_mm = 35.0, cortex_before_mm = 12.0, cortex_behind_mm = 45.0;
// A point this near to the face's own depth belongs to the face.
constexpr double face_thickness_mm = 2.0;

RayLattice lattice_for(const Task& task, double reach_mm, double spacing_mm) {
  // Five times as wide as a glenoid is high; rays of wider ones would fill the memory.
  if (reach_mm > 110.0)
    throw Error(ErrorKind::invalid_input, "the reamer is too wide for a glenoid; at most 200 mm across");
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

uint64_t OuterCortex::key_of(const Vec3i& cell) {
  const auto part = [](int c) {
    return static_cast<uint64_t>(static_cast<uint32_t>(c + (1 << 20))) & 0x1fffff;
  };
  return part(cell.x()) | part(cell.y()) << 21 | part(cell.z()) << 42;
}

OuterCortex::OuterCortex(const voxel::BoneModel& native, const Aabb& world_box_mm,
                         const std::function<bool(const Vec3&)>& is_face)
    : origin_mm_(world_box_mm.centre()) {
  const voxel::VoxelGrid& grid = native.grid;
  const std::vector<Filling> fillings = fillings_of(native);
  std::vector<std::pair<uint64_t, Vec3f>> found;
  const double brick_mm = voxel::brick_edge * grid.spacing_mm.maxCoeff();
  const Aabb near_box = world_box_mm.grown(2.0 * brick_mm);
  for (uint32_t i = 0; i < fillings.size(); ++i) {
    const Vec3i brick = grid.brick_coordinates(i);
    if (has_no_surface(grid, fillings, brick)) continue;
    if (!near_box.contains(grid.world_from_grid.point(grid.centre_mm(brick * voxel::brick_edge)))) continue;
    for_each_crossing(native, brick, [&](const Vec3& point) {
      const Vec3 world = grid.world_from_grid.point(point);
      if (!world_box_mm.contains(world) || is_face(world)) return;
      const Vec3 offset = world - origin_mm_;
      found.emplace_back(key_of(cell_of(offset, min_spacing_mm)), offset.cast<float>());
    });
  }
  // Of a cell the point nearest to the middle of all is kept: that is the same in a mirror image.
  const auto before = [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second.squaredNorm() < b.second.squaredNorm();
  };
  std::stable_sort(found.begin(), found.end(), before);
  const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
  for (auto& [key, point] : found) key = key_of(cell_of(point.cast<double>(), cell_mm));
  std::stable_sort(found.begin(), found.end(), before);
  points_mm_.reserve(found.size());
  for (const auto& [key, point] : found) {
    auto& range = cells_.try_emplace(key, static_cast<uint32_t>(points_mm_.size()), 0u).first->second;
    points_mm_.push_back(point);
    range.second = static_cast<uint32_t>(points_mm_.size());
  }
}

std::optional<double> OuterCortex::distance_mm(const Vec3& world_mm, double reach_mm) const {
  const Vec3 offset = world_mm - origin_mm_;
  const Vec3f target = offset.cast<float>();
  const Vec3i middle = cell_of(offset, cell_mm);
  float nearest2 = static_cast<float>(reach_mm * reach_mm);
  bool any = false;
  const auto look = [&](const Vec3i& cell) {
    const auto range = cells_.find(key_of(cell));
    if (range == cells_.end()) return;
    for (uint32_t i = range->second.first; i < range->second.second; ++i) {
      const float distance2 = (points_mm_[i] - target).squaredNorm();
      any = any || distance2 <= nearest2;
      nearest2 = std::min(nearest2, distance2);
    }
  };
  // Shell after shell of cells, until the next cannot hold anything nearer.
  for (int shell = 0; (shell - 1) * cell_mm < std::sqrt(static_cast<double>(nearest2)); ++shell)
    for (int z = -shell; z <= shell; ++z)
      for (int y = -shell; y <= shell; ++y)
        for (int x = -shell; x <= shell; ++x)
          if (std::max({std::abs(x), std::abs(y), std::abs(z)}) == shell) look(middle + Vec3i(x, y, z));
  return any ? std::optional(std::sqrt(static_cast<double>(nearest2))) : std::nullopt;
}

SubchondralPlate find_plate(const voxel::BoneModel& bone, const RayLattice& rays,
                            const std::vector<double>& subchondral_mm, const std::vector<uint8_t>& face) {
  SubchondralPlate plate;
  plate.thickness_mm.assign(rays.size(), SubchondralPlate::assumed_mm);
  const DensityProbe probe(bone, rays);
  const double step_mm = 0.5 * bone.grid.min_spacing_mm();
  const auto limit = limit_density(probe, subchondral_mm, face, step_mm);
  if (!limit) return plate;
  std::vector<double> ends;
  std::vector<size_t> without;
  size_t count = 0;
  for (size_t ray = 0; ray < rays.size(); ++ray) {
    if (!face[ray]) continue;
    ++count;
    const auto end = end_of_plate(probe, ray, subchondral_mm[ray], *limit, step_mm);
    if (end)
      ends.push_back(plate.thickness_mm[ray] = *end);
    else
      without.push_back(ray);
  }
  if (static_cast<double>(ends.size()) < enough_share * static_cast<double>(count)) {
    plate.thickness_mm.assign(rays.size(), SubchondralPlate::assumed_mm);
    return plate;
  }
  plate.found_by_density = true;
  plate.median_mm = median(std::move(ends));
  for (const size_t ray : without) plate.thickness_mm[ray] = plate.median_mm;
  return plate;
}

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
