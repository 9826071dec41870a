#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "collide/removal/removal.hpp"
#include "shell/point_shell.hpp"

namespace ream::collide {

/// Consecutive points of a DecayShell, near each other.
struct DecayRun {
  uint32_t first = 0, count = 0;
  Vec3f centre_mm = Vec3f::Zero();  ///< bounding sphere, tool frame
  float radius_mm = 0;
};

/// Points a run may have at most.
inline constexpr uint32_t decay_run_points = 256;

/// The cutting points of a PointShell, where they lie on the true surface, tool frame, mm: what algorithm 4.1
/// removes bone with. Made only for sessions that remove by decay; 12 bytes a point.
struct DecayShell {
  std::vector<float> x_mm, y_mm, z_mm;  ///< Morton order
  std::vector<DecayRun> runs;

  size_t size() const { return x_mm.size(); }
};

DecayShell make_decay_shell(const shell::PointShell& shell);

/// Coverage that a point takes from its voxel in a tick. A voxel with one point in it is gone after 16 ticks,
/// so it keeps up with 5 mm/s where voxels are 0.08 mm: the feed of 52 N (at most 0.42 mm/s, eq. 5.2) and of
/// ten times that never outruns it. Engineering choice; the thesis names no value.
inline constexpr int default_decay_levels = 16;

/// What removal by decay works on.
struct DecayInput {
  const DecayShell& shell;
  voxel::BoneModel& bone;
  int levels = default_decay_levels;  ///< 1 to 255, taken by a point from its voxel in a tick
};

/// The thesis' algorithm 4.1 without its race: every cutting point that lies in bone lowers the coverage of
/// its voxel by a fixed step, down to 0; density stays. The order of points cannot matter, because taking a
/// and then b, each down to 0 at most, is taking a + b at once: max(0, max(0, c - a) - b) = max(0, c - a - b)
/// for a, b >= 0. Kept as a reference: it leaves columns standing between points that lie farther apart than
/// voxels, which the swept profile does not. All memory is allocated at construction.
class Decay {
 public:
  explicit Decay(const DecayInput& input);
  virtual ~Decay() = default;

  /// One tick at `grid_from_tool`. bone.coverage on the host is up to date when it returns. The change hash
  /// sums, over changed voxels, mix64(change_key) of what they have now less that of what they had before.
  /// False when the device failed: bone.coverage is then as it was before.
  bool apply(const QuantisedPose& grid_from_tool, RemovalSums& sums) noexcept;
  /// Bricks that the last apply() changed, each once.
  std::span<const uint32_t> changed_bricks() const { return {changed_.data(), changed_count_}; }
  /// Takes the changed bricks to a device with memory of its own. False when it failed; the host is right.
  virtual bool publish() noexcept { return true; }

 protected:
  /// Voxels (VoxelGrid::index) of the points of the listed runs that lie in bone; no_voxel for other points.
  struct Hits {
    std::span<const uint32_t> voxels;
    bool ok = true;  ///< false: the device failed
  };
  virtual Hits find_hits(const GridAffine& voxel_from_tool, std::span<const uint32_t> runs) noexcept = 0;
  static constexpr uint32_t no_voxel = 0xffffffffu;

  const DecayInput in_;

 private:
  std::span<const uint32_t> runs_near_bone(const GridAffine& voxel_from_tool) noexcept;
  void lower(uint32_t voxel, RemovalSums& sums) noexcept;

  std::array<voxel::BoneClass, 256> classes_;
  Vec3f bone_low_, bone_high_;  ///< box around all coverage at the start, voxels
  std::vector<uint32_t> runs_, changed_;
  size_t changed_count_ = 0;
  std::vector<uint8_t> is_changed_;  ///< a bit a brick
};

std::unique_ptr<Decay> make_decay_cpu(const DecayInput& input);

}  // namespace ream::collide
