#include "score/outer_cortex.hpp"

#include <algorithm>
#include <cmath>

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
      found.emplace_back(key_of(cell_of(offset, finest_mm)), offset.cast<float>());
    });
  }
  const auto by_key = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::stable_sort(found.begin(), found.end(), by_key);
  const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
  for (auto& [key, point] : found) key = key_of(cell_of(point.cast<double>(), cell_mm));
  std::stable_sort(found.begin(), found.end(), by_key);
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

}  // namespace ream::score
