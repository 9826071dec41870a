#include "collide/removal/removal_schedule.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "core/hash.hpp"
#include "core/units.hpp"
#include "geometry/ordered_product.hpp"
#include "voxel/bricks.hpp"

namespace ream::collide {
namespace {

/// Motion between two lists of near bricks, voxels.
constexpr double relist_voxels = 1.0;

constexpr int word_bits = 32;

/// A fraction in (0, 1] that differs from brick to brick.
float phase(uint32_t brick) { return static_cast<float>(mix64(brick) % 64 + 1) / 64.0f; }

}  // namespace

RemovalSchedule::RemovalSchedule(const shell::SweptProfile& profile, const voxel::BoneModel& bone)
    : profile_(profile),
      grid_(bone.grid),
      body_tool_mm_{Vec3(-profile.max_radius_mm, -profile.max_radius_mm, profile.body_min_z_mm),
                    Vec3(profile.max_radius_mm, profile.max_radius_mm, profile.body_max_z_mm)},
      odometer_(body_tool_mm_, bone.grid.min_spacing_mm()),
      brick_reach_mm_(0.5 * voxel::brick_edge * ordered_norm(bone.grid.spacing_mm) +
                      0.5 * bone.grid.spacing_mm.maxCoeff()),
      near_mm_(brick_reach_mm_ + 2.0 * relist_voxels * bone.grid.spacing_mm.maxCoeff()),
      words_a_row_((bone.grid.brick_dims().x() + word_bits - 1) / word_bits) {
  const Vec3i bricks = grid_.brick_dims();
  occupied_.resize(static_cast<size_t>(words_a_row_) * static_cast<size_t>(bricks.y() * bricks.z()));
  for (uint32_t b = 0; b < grid_.brick_count(); ++b) {
    const uint8_t* coverage = bone.coverage.data() + grid_.brick_base(b);
    if (std::all_of(coverage, coverage + voxel::brick_voxels, [](uint8_t c) { return c == 0; })) continue;
    const int x = grid_.brick_coordinates(b).x();
    const size_t row = b / static_cast<uint32_t>(bricks.x());
    occupied_[row * static_cast<size_t>(words_a_row_) + static_cast<size_t>(x / word_bits)] |=
        1u << (x % word_bits);
  }
  near_.resize(max_near_bricks());
  next_.resize(near_.size());
}

double RemovalSchedule::needed_margin_mm(const voxel::VoxelGrid& grid) {
  return 0.5 * voxel::brick_edge * ordered_norm(grid.spacing_mm) + 3.0 * grid.spacing_mm.maxCoeff();
}

/// The bricks whose centres lie within near_mm_ of the cylinder around the body fill at most that cylinder,
/// grown by near_mm_ and half a brick's diagonal.
size_t RemovalSchedule::max_near_bricks() const {
  const double grown_mm = near_mm_ + 0.5 * voxel::brick_edge * ordered_norm(grid_.spacing_mm);
  const double radius_mm = profile_.max_radius_mm + grown_mm;
  const double height_mm = profile_.body_max_z_mm - profile_.body_min_z_mm + 2.0 * grown_mm;
  const double bricks =
      pi * radius_mm * radius_mm * height_mm / (grid_.voxel_volume_mm3() * voxel::brick_voxels);
  return static_cast<size_t>(std::min(static_cast<double>(grid_.brick_count()), std::ceil(bricks)));
}

float RemovalSchedule::brick_distance_mm(const Vec3i& brick, const GridAffine& a) const noexcept {
  constexpr float half = 0.5f * (voxel::brick_edge - 1);
  const float u = static_cast<float>(brick.x() * voxel::brick_edge) + half,
              v = static_cast<float>(brick.y() * voxel::brick_edge) + half,
              w = static_cast<float>(brick.z() * voxel::brick_edge) + half;
  const float x = a.m[0] * u + a.m[1] * v + a.m[2] * w + a.t[0];
  const float y = a.m[3] * u + a.m[4] * v + a.m[5] * w + a.t[1];
  const float z = a.m[6] * u + a.m[7] * v + a.m[8] * w + a.t[2];
  return profile_.at(x * x + y * y, z);
}

/// Motion before a brick at that distance can be touched, voxels; 0 when it may be touched already.
float RemovalSchedule::wait_voxels(float brick_distance_mm) const noexcept {
  const double gap_mm = static_cast<double>(brick_distance_mm) - brick_reach_mm_;
  if (gap_mm <= 0.0) return 0.0f;
  return static_cast<float>(std::max(gap_mm / grid_.spacing_mm.maxCoeff(), revisit_voxels));
}

void RemovalSchedule::find_near_bricks(const Pose& grid_from_tool) noexcept {
  const Aabb box = body_tool_mm_.transformed(grid_from_tool).grown(near_mm_).intersection(grid_.bounds_mm());
  next_count_ = 0;
  if (!box.empty()) {
    const Vec3i last_brick = grid_.brick_dims() - Vec3i::Ones();
    const Vec3i low = (grid_.voxel_at(box.min) / voxel::brick_edge).cwiseMax(0).cwiseMin(last_brick);
    const Vec3i high = (grid_.voxel_at(box.max) / voxel::brick_edge).cwiseMax(0).cwiseMin(last_brick);
    const GridAffine affine = tool_from_voxel(quantised(grid_from_tool), grid_);
    size_t old = 0;
    for (int z = low.z(); z <= high.z(); ++z)
      for (int y = low.y(); y <= high.y(); ++y) scan_row(y, z, low.x(), high.x(), affine, old);
  }
  const uint32_t asked_first = turn_ < near_count_ ? near_[turn_].brick : 0;
  std::swap(near_, next_);
  near_count_ = next_count_;
  base_voxels_ = odometer_.voxels();
  turn_ = static_cast<size_t>(
      std::partition_point(near_.begin(), near_.begin() + static_cast<std::ptrdiff_t>(near_count_),
                           [&](const Near& near) { return near.brick < asked_first; }) -
      near_.begin());
  if (turn_ == near_count_) turn_ = 0;
  listed_ = true;
}

/// Appends the near bricks of a row to next_; what near_ knows of them is kept (both ascend, `old` follows).
void RemovalSchedule::scan_row(int y, int z, int first_x, int last_x, const GridAffine& affine,
                               size_t& old) noexcept {
  const Vec3i bricks = grid_.brick_dims();
  const uint32_t* words =
      occupied_.data() + static_cast<size_t>(words_a_row_) * static_cast<size_t>(y + bricks.y() * z);
  for (int word = first_x / word_bits; word <= last_x / word_bits; ++word)
    for (uint32_t bits = words[word]; bits != 0; bits &= bits - 1) {
      const int x = word * word_bits + std::countr_zero(bits);
      if (x < first_x || x > last_x) continue;
      const float distance_mm = brick_distance_mm({x, y, z}, affine);
      if (static_cast<double>(distance_mm) > near_mm_ || next_count_ == next_.size()) continue;
      const uint32_t brick = grid_.brick_index({x, y, z});
      while (old < near_count_ && near_[old].brick < brick) ++old;
      const bool known = old < near_count_ && near_[old].brick == brick;
      next_[next_count_++] = {brick, known ? near_[old].due_voxels - gone() : wait_voxels(distance_mm)};
    }
}

std::span<const uint32_t> RemovalSchedule::due(const QuantisedPose& grid_from_tool) noexcept {
  const Pose pose = dequantised(grid_from_tool);
  odometer_.advance(pose);
  const bool stale = !listed_ || odometer_.voxels() >= base_voxels_ + relist_voxels;
  if (stale) find_near_bricks(pose);
  const size_t most = stale ? max_bricks_per_tick / 4 : max_bricks_per_tick;
  const GridAffine affine = tool_from_voxel(grid_from_tool, grid_);
  const float now = gone();
  size_t n = 0, at = turn_;
  for (size_t asked = 0; asked < near_count_ && n < most; ++asked) {
    Near& near = near_[at];
    if (near.due_voxels <= now) {
      const float wait = wait_voxels(brick_distance_mm(grid_.brick_coordinates(near.brick), affine));
      if (wait > 0.0f) {
        near.due_voxels = now + wait;
      } else {
        entry_[n] = static_cast<uint32_t>(at);
        due_[n++] = near.brick;
      }
    }
    at = at + 1 < near_count_ ? at + 1 : 0;
  }
  turn_ = at;
  return {due_.data(), n};
}

void RemovalSchedule::cut_done(size_t i, const BrickOutcome& outcome) noexcept {
  Near& near = near_[entry_[i]];
  if (outcome.empty) {
    const auto row = near.brick / static_cast<uint32_t>(grid_.brick_dims().x());
    const int x = grid_.brick_coordinates(near.brick).x();
    occupied_[row * static_cast<size_t>(words_a_row_) + static_cast<size_t>(x / word_bits)] &=
        ~(1u << (x % word_bits));
  }
  const float now = gone();
  constexpr auto revisit = static_cast<float>(revisit_voxels);
  const float slack_voxels = outcome.slack_levels * (1.0f / 255.0f);
  if (slack_voxels > revisit) {
    near.due_voxels = now + slack_voxels;
    return;
  }
  // Bricks that became due together (at a first contact, say) get phases of their own, so that later ticks
  // share the work evenly.
  const float regular = near.due_voxels + revisit;
  near.due_voxels = regular > now ? regular : now + revisit * phase(near.brick);
}

void RemovalSchedule::pass(const QuantisedPose& grid_from_tool) noexcept {
  odometer_.advance(dequantised(grid_from_tool));
}

}  // namespace ream::collide
