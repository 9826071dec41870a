#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "collide/broad_phase.hpp"
#include "collide/contact_shell.hpp"
#include "collide/grid_affine.hpp"
#include "voxel/brick_distance.hpp"
#include "voxel/occupancy.hpp"

namespace ream::collide {

/// A voxel with at least this coverage engages a probe.
inline constexpr int engaging_coverage = 128;

/// Exact integer sums over the engaged points: equal on every device and in any order. With weights up to 28,
/// components up to 127 and 2 M points the products stay below 2^40.
struct ContactSums {
  struct Part {
    int64_t points = 0;
    /// Sum of w g_i over the 6 components of ContactVector, then sum of w.
    std::array<int64_t, 7> first{};
    /// Sum of w g_i g_j, upper triangle row by row: 00 01 .. 05 11 12 .. 55.
    std::array<int64_t, 21> second{};
    bool operator==(const Part&) const = default;
  };
  Part cutting, guiding;
  /// Engaged cutting points and the sum of their density codes, by voxel::BoneClass. Cartilage counts its
  /// code.
  std::array<int64_t, voxel::bone_class_count> class_points{}, class_density{};

  int64_t engaged() const { return cutting.points + guiding.points; }
  bool operator==(const ContactSums&) const = default;
};

/// What the narrow phases share: the prepared shell, the bone they look at, and what culls.
struct NarrowPhaseInput {
  const ContactShell& shell;
  const voxel::BoneModel& bone;  ///< read live: removal between two calls is seen
  const voxel::BrickDistance& distance;
  const voxel::Occupancy& occupancy;
};

/// Finds the engaged points of the shell. All memory is allocated at construction; contact() is called from
/// the tick.
class NarrowPhase {
 public:
  virtual ~NarrowPhase() = default;
  /// Sums at one pose. `voi` comes from the broad phase at the same pose. False when the device failed;
  /// `sums` is then not to be used.
  virtual bool contact(const QuantisedPose& grid_from_tool, const Voi& voi, ContactSums& sums) noexcept = 0;
};

std::unique_ptr<NarrowPhase> make_narrow_phase_cpu(const NarrowPhaseInput& input);

/// Blocks that may hold engaged points: inside the VOI and near enough to bone by the conservative distance.
/// Writes block numbers to `survivors` (room for all blocks) and returns how many. Shared by all narrow
/// phases.
size_t cull_blocks(const ContactShell& shell, const voxel::BrickDistance& distance, const Voi& voi,
                   const GridAffine& voxel_from_tool, float min_spacing_mm,
                   std::span<uint32_t> survivors) noexcept;

}  // namespace ream::collide
