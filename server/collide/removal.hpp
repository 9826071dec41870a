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

/// Coverage a voxel keeps at a signed distance (mm, outside positive) of its centre to the swept cutting
/// body: 255 from half a voxel outside, 0 from half a voxel inside, linear between (DESIGN 3).
/// `levels_per_mm` is 255 / voxel edge.
inline uint8_t kept_coverage(float distance_mm, float levels_per_mm) noexcept {
  const float level = distance_mm * levels_per_mm + 128.0f;
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
};

/// Cuts bone by the swept profile: coverage = min(coverage, kept_coverage(distance)): absolute, idempotent,
/// order-free. All memory is allocated at construction; cut() is called from the tick, by the one writer of
/// the grid.
class Removal {
 public:
  virtual ~Removal() = default;
  /// Applies the body at `grid_from_tool` to the listed bricks (each at most once). `changed[i]` becomes 1
  /// when brick i of the list changed, and `empty[i]` 1 when nothing of it is left. bone.coverage on the host
  /// is up to date when it returns. False when the device failed.
  virtual bool cut(const QuantisedPose& grid_from_tool, std::span<const uint32_t> bricks,
                   std::span<uint8_t> changed, std::span<uint8_t> empty, RemovalSums& sums) noexcept = 0;
};

struct RemovalInput {
  const shell::SweptProfile& profile;
  voxel::BoneModel& bone;
};

std::unique_ptr<Removal> make_removal_cpu(const RemovalInput& input);

/// 255 / smallest voxel edge, as both forms use it.
float coverage_levels_per_mm(const voxel::VoxelGrid& grid);

}  // namespace ream::collide
