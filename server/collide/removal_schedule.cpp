#include "collide/removal_schedule.hpp"

#include <algorithm>
#include <cmath>

#include "core/hash.hpp"
#include "voxel/bricks.hpp"

namespace ream::collide {
namespace {

/// Motion between two builds of the active list, voxels.
constexpr double rebuild_voxels = 1.0;

/// A fraction in (0, 1] that differs from brick to brick.
double phase(uint32_t brick) { return static_cast<double>(mix64(brick) % 64 + 1) / 64.0; }

Vec3 corner(const Aabb& box, int i) {
  return {i & 1 ? box.max.x() : box.min.x(), i & 2 ? box.max.y() : box.min.y(),
          i & 4 ? box.max.z() : box.min.z()};
}

}  // namespace

RemovalSchedule::RemovalSchedule(const shell::SweptProfile& profile, const voxel::BoneModel& bone)
    : profile_(profile),
      table_(profile),
      bone_(bone),
      grid_(bone.grid),
      brick_reach_mm_(0.5 * voxel::brick_edge * bone.grid.spacing_mm.norm() +
                      0.5 * bone.grid.spacing_mm.maxCoeff()),
      empty_(bone.grid.brick_count()),
      hot_(bone.grid.brick_count()),
      due_at_(bone.grid.brick_count()),
      active_(bone.grid.brick_count()),
      due_(bone.grid.brick_count()) {
  const double r = profile.max_radius_mm;
  body_tool_mm_ = {Vec3(-r, -r, profile.body_min_z_mm), Vec3(r, r, profile.body_max_z_mm)};
  uint8_t image[voxel::brick_voxels];
  for (uint32_t b = 0; b < empty_.size(); ++b) {
    voxel::read_brick(grid_, bone.coverage.data(), b, image);
    empty_[b] = std::all_of(image, image + voxel::brick_voxels, [](uint8_t c) { return c == 0; });
  }
}

double RemovalSchedule::needed_margin_mm(const voxel::VoxelGrid& grid) {
  return 0.5 * voxel::brick_edge * grid.spacing_mm.norm() + 3.0 * grid.spacing_mm.maxCoeff();
}

double RemovalSchedule::advance_odometer(const Pose& grid_from_tool) noexcept {
  double moved = 0.0;
  if (started_)
    for (int i = 0; i < 8; ++i) {
      const Vec3 p = corner(body_tool_mm_, i);
      moved = std::max(moved, length_bound(grid_from_tool.point(p) - previous_.point(p)));
    }
  started_ = true;
  previous_ = grid_from_tool;
  odometer_voxels_ = odometer_voxels_ + moved / grid_.min_spacing_mm();
  return odometer_voxels_;
}

float RemovalSchedule::brick_distance_mm(uint32_t brick, const GridAffine& a) const noexcept {
  const Vec3i first = grid_.brick_coordinates(brick) * voxel::brick_edge;
  const float half = 0.5f * (voxel::brick_edge - 1);
  const float u = static_cast<float>(first.x()) + half, v = static_cast<float>(first.y()) + half,
              w = static_cast<float>(first.z()) + half;
  const float x = a.m[0] * u + a.m[1] * v + a.m[2] * w + a.t[0];
  const float y = a.m[3] * u + a.m[4] * v + a.m[5] * w + a.t[1];
  const float z = a.m[6] * u + a.m[7] * v + a.m[8] * w + a.t[2];
  return profile_.at(x * x + y * y, z);
}

void RemovalSchedule::rebuild_active(const Pose& grid_from_tool) noexcept {
  const Aabb box = body_tool_mm_.transformed(grid_from_tool)
                       .grown(2.0 * rebuild_voxels * grid_.spacing_mm.maxCoeff())
                       .intersection(grid_.bounds_mm());
  active_count_ = 0;
  rebuild_at_ = odometer_voxels_ + rebuild_voxels;
  if (box.empty()) return;
  const Vec3i last_brick = grid_.brick_dims() - Vec3i::Ones();
  const Vec3i low = (grid_.voxel_at(box.min) / voxel::brick_edge).cwiseMax(0).cwiseMin(last_brick);
  const Vec3i high = (grid_.voxel_at(box.max) / voxel::brick_edge).cwiseMax(0).cwiseMin(last_brick);
  const GridAffine affine = tool_from_voxel(quantised(grid_from_tool), grid_);
  const double near_mm = brick_reach_mm_ + 2.0 * rebuild_voxels * grid_.spacing_mm.maxCoeff();
  for (int z = low.z(); z <= high.z(); ++z)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int x = low.x(); x <= high.x(); ++x) {
        const uint32_t brick = grid_.brick_index({x, y, z});
        if (!empty_[brick] && brick_distance_mm(brick, affine) <= near_mm) active_[active_count_++] = brick;
      }
}

void RemovalSchedule::follow(const QuantisedPose& grid_from_tool) noexcept {
  const Pose pose = dequantised(grid_from_tool);
  if (advance_odometer(pose) >= rebuild_at_) rebuild_active(pose);
}

double RemovalSchedule::gap_voxels(uint32_t brick, const GridAffine& affine) const noexcept {
  return (static_cast<double>(brick_distance_mm(brick, affine)) - brick_reach_mm_) /
         grid_.spacing_mm.maxCoeff();
}

double RemovalSchedule::measured_gap_voxels(uint32_t brick, const GridAffine& affine) const noexcept {
  alignas(64) float distances_mm[voxel::brick_voxels];
  alignas(64) uint8_t coverage[voxel::brick_voxels];
  brick_distances_mm(table_, affine, grid_.brick_coordinates(brick) * voxel::brick_edge, distances_mm);
  voxel::read_brick(grid_, bone_.coverage.data(), brick, coverage);
  float nearest_mm = shell::SweptProfile::far;
  for (int i = 0; i < voxel::brick_voxels; ++i) {
    const float d = coverage[i] != 0 ? distances_mm[i] : shell::SweptProfile::far;
    nearest_mm = d < nearest_mm ? d : nearest_mm;
  }
  // The table is clamped at its margin, so a distance is never taken for more than that.
  const double largest_mm = grid_.spacing_mm.maxCoeff();
  return (std::min<double>(nearest_mm, profile_.margin_mm) - 0.5 * largest_mm) / largest_mm;
}

std::span<const uint32_t> RemovalSchedule::due(const QuantisedPose& grid_from_tool) noexcept {
  follow(grid_from_tool);
  const GridAffine affine = tool_from_voxel(grid_from_tool, grid_);
  size_t n = 0;
  for (size_t i = 0; i < active_count_; ++i) {
    const uint32_t brick = active_[i];
    if (empty_[brick] || odometer_voxels_ < due_at_[brick]) continue;
    double gap = gap_voxels(brick, affine);
    if (gap <= 0.0 && !hot_[brick]) gap = measured_gap_voxels(brick, affine);
    if (gap > revisit_voxels) {
      due_at_[brick] = odometer_voxels_ + gap;
      continue;
    }
    // Bricks that became due together (at a first contact, say) get phases of their own, so that later ticks
    // share the work evenly.
    const double regular = due_at_[brick] + revisit_voxels;
    due_at_[brick] = regular > odometer_voxels_ ? regular : odometer_voxels_ + revisit_voxels * phase(brick);
    if (gap <= 0.0) due_[n++] = brick;
  }
  return {due_.data(), n};
}

void RemovalSchedule::pass(const QuantisedPose& grid_from_tool) noexcept {
  follow(grid_from_tool);
  const GridAffine affine = tool_from_voxel(grid_from_tool, grid_);
  size_t measured = 0;
  for (size_t i = 0; i < active_count_ && measured < idle_budget; ++i) {
    next_to_measure_ = next_to_measure_ + 1 < active_count_ ? next_to_measure_ + 1 : 0;
    const uint32_t brick = active_[next_to_measure_];
    if (empty_[brick] || odometer_voxels_ < due_at_[brick]) continue;
    double gap = gap_voxels(brick, affine);
    if (gap <= 0.0) {
      gap = measured_gap_voxels(brick, affine);
      ++measured;
    }
    // A brick that would be cut stays due: it is only measured here.
    if (gap > 0.0) due_at_[brick] = odometer_voxels_ + gap;
  }
}

void RemovalSchedule::cut_done(uint32_t brick, bool changed, bool empty) noexcept {
  hot_[brick] = changed;
  if (empty) empty_[brick] = 1;
}

}  // namespace ream::collide
