#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "collide/grid_transform.hpp"
#include "shell/swept_profile.hpp"
#include "voxel/bone_model.hpp"

namespace ream::collide {

/// Coverage that a voxel keeps at most, from its level: 255 where the voxel's centre is half a voxel outside
/// the swept cutting body, 0 half a voxel inside, linear between. The level goes on beyond both.
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
inline constexpr size_t max_bricks_per_cut = 256;

/// Cuts bone by the swept profile: coverage = min(coverage, kept_coverage): absolute, idempotent, order-free.
/// All memory is allocated at construction; cut() is called from the tick, by the one writer of the grid.
class Removal {
 public:
  virtual ~Removal() = default;
  /// Applies the body at `grid_from_tool` to the listed bricks (each at most once, at most
  /// max_bricks_per_cut); `outcomes` are theirs. bone.coverage on the host is up to date when it returns.
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

/// The swept profile's table in 16-bit steps, so that one load brings two neighbours. Table coordinates are
/// clamped: the table's margin is wider than half a voxel, so its border keeps everything. The order of
/// operations is that of kernels/removal.cl.
struct ProfileTable {
  /// Distances at r2 cells i (low half) and i + 1 (high half), in steps; [z][r2], r2 fastest.
  std::vector<int32_t> pairs;
  int r2_count = 0;
  float z_min_mm = 0, inverse_z_step = 0, inverse_r2_step = 0;
  float r2_limit = 0, z_limit = 0;  ///< last usable table coordinates
  float levels_per_step = 0;        ///< coverage levels (255 a voxel edge) in one step of distance
};

/// `levels_per_mm` as coverage_levels_per_mm() gives it. A step is a power of two, at most 1/16000 of the
/// profile's margin; distances beyond the margin count as far.
ProfileTable profile_table(const shell::SweptProfile& profile, float levels_per_mm);

/// Levels (kept_coverage() of removal.hpp) of the 512 voxels of the brick whose minimum voxel is `first`, x
/// fastest: 128 plus the signed distance of the voxel centre in levels.
void brick_levels(const ProfileTable& table, const GridAffine& tool_from_voxel, const Vec3i& first,
                  float* levels) noexcept;

}  // namespace ream::collide
