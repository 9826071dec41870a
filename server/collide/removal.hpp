#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "collide/grid_affine.hpp"
#include "shell/swept_profile.hpp"
#include "voxel/bone_model.hpp"

namespace ream::collide {

/// Coverage that a voxel keeps at most, from its level: 255 where the voxel's centre is half a voxel outside
/// the swept cutting body, 0 half a voxel inside, linear between (DESIGN 3). The level goes on beyond both.
inline uint8_t kept_coverage(float level) noexcept {
  const float low = level < 0.0f ? 0.0f : level;
  return static_cast<uint8_t>(static_cast<int>(low > 255.0f ? 255.0f : low));
}

/// One voxel's change as it enters the order-free hash.
constexpr uint64_t change_key(uint64_t voxel_index, uint8_t coverage) { return voxel_index * 256 + coverage; }

/// What one tick removed. Sums are exact integers, the same for every order and device.
struct RemovalSums {
  uint64_t change_hash = 0;  ///< sum of mix64(change_key) over changed voxels, modulo 2^64
  std::array<int64_t, voxel::bone_class_count> coverage_removed{};  ///< coverage levels by voxel::BoneClass
  uint32_t changed_bricks = 0;
  bool operator==(const RemovalSums&) const = default;
};

/// What became of one brick.
struct BrickOutcome {
  bool changed = false, empty = false;  ///< empty: nothing of it is left
  /// Least level above its coverage of any voxel that is left. While no point of the tool moves by as many
  /// 255ths of a voxel, the brick does not change; untouched_levels for an empty one.
  float slack_levels = 0.0f;
  bool operator==(const BrickOutcome&) const = default;
};
inline constexpr float untouched_levels = 1.0e9f;

/// Longest list of bricks for one cut.
inline constexpr size_t most_bricks_a_cut = 256;

/// Cuts bone by the swept profile: coverage = min(coverage, kept_coverage): absolute, idempotent, order-free.
/// All memory is allocated at construction; cut() is called from the tick, by the one writer of the grid.
class Removal {
 public:
  virtual ~Removal() = default;
  /// Applies the body at `grid_from_tool` to the listed bricks (each at most once, at most
  /// most_bricks_a_cut); `outcomes` are theirs. bone.coverage on the host is up to date when it returns.
  /// False when the device failed: bone.coverage is then as it was before, and the rest is not to be used.
  virtual bool cut(const QuantisedPose& grid_from_tool, std::span<const uint32_t> bricks,
                   std::span<BrickOutcome> outcomes, RemovalSums& sums) noexcept = 0;
};

struct RemovalInput {
  const shell::SweptProfile& profile;
  voxel::BoneModel& bone;
};

std::unique_ptr<Removal> make_removal_cpu(const RemovalInput& input);

/// 255 / smallest voxel edge, as both forms use it.
float coverage_levels_per_mm(const voxel::VoxelGrid& grid);

}  // namespace ream::collide
