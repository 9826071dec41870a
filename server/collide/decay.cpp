#include "collide/decay.hpp"

#include <algorithm>

#include "core/hash.hpp"

namespace ream::collide {
namespace {

/// Covers rounding in the place of a run's sphere, voxels.
constexpr float slack_voxels = 1.0f;

}  // namespace

Decay::Decay(const DecayInput& input)
    : in_(input),
      classes_(voxel::class_table(input.bone.cortical_threshold_g_cc)),
      runs_(input.shell.runs.size()),
      changed_(std::min(input.shell.size(), input.bone.grid.brick_count())),
      is_changed_((input.bone.grid.brick_count() + 7) / 8) {
  Vec3i low = input.bone.grid.dims, high = Vec3i::Zero();
  for (size_t i = 0; i < input.bone.coverage.size(); ++i) {
    if (input.bone.coverage[i] == 0) continue;
    const Vec3i at = input.bone.grid.coordinates(i);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at + Vec3i::Ones());
  }
  bone_low_ = low.cast<float>();
  bone_high_ = high.cast<float>();
}

bool Decay::apply(const QuantisedPose& grid_from_tool, RemovalSums& sums) noexcept {
  sums = {};
  changed_count_ = 0;
  const GridAffine affine = voxel_from_tool(grid_from_tool, in_.bone.grid);
  const Hits hits = find_hits(affine, runs_near_bone(affine));
  if (!hits.ok) return false;
  for (const uint32_t voxel : hits.voxels)
    if (voxel != no_voxel) lower(voxel, sums);
  sums.changed_bricks = static_cast<uint32_t>(changed_count_);
  for (const uint32_t brick : changed_bricks()) is_changed_[brick / 8] = 0;
  return true;
}

std::span<const uint32_t> Decay::runs_near_bone(const GridAffine& a) noexcept {
  const float voxels_per_mm = static_cast<float>(1.0 / in_.bone.grid.min_spacing_mm());
  size_t n = 0;
  for (uint32_t i = 0; i < runs_.size(); ++i) {
    const DecayRun& run = in_.shell.runs[i];
    const float reach = run.radius_mm * voxels_per_mm + slack_voxels;
    bool near = true;
    for (int k = 0; k < 3; ++k) {
      const float at = a.m[3 * k] * run.centre_mm.x() + a.m[3 * k + 1] * run.centre_mm.y() +
                       a.m[3 * k + 2] * run.centre_mm.z() + a.t[k];
      near = near && at + reach >= bone_low_[k] && at - reach <= bone_high_[k];
    }
    if (near) runs_[n++] = i;
  }
  return {runs_.data(), n};
}

/// The hash's terms telescope: what all steps of a voxel add is its last state less its first.
void Decay::lower(uint32_t voxel, RemovalSums& sums) noexcept {
  uint8_t& coverage = in_.bone.coverage[voxel];
  if (coverage == 0) return;
  const int left = std::max(0, coverage - in_.levels);
  sums.coverage_removed[static_cast<size_t>(classes_[in_.bone.density[voxel]])] += coverage - left;
  sums.change_hash +=
      mix64(change_key(voxel, static_cast<uint8_t>(left))) - mix64(change_key(voxel, coverage));
  coverage = static_cast<uint8_t>(left);
  const uint32_t brick = voxel / voxel::brick_voxels;
  const auto bit = static_cast<uint8_t>(1u << (brick % 8));
  if (is_changed_[brick / 8] & bit) return;
  is_changed_[brick / 8] |= bit;
  changed_[changed_count_++] = brick;
}

}  // namespace ream::collide
