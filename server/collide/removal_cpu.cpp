#include <cstring>

#include "collide/profile_table.hpp"
#include "collide/removal.hpp"
#include "core/hash.hpp"
#include "core/vector_clones.hpp"
#include "voxel/bricks.hpp"

namespace ream::collide {
namespace {

using voxel::brick_edge;
using voxel::brick_voxels;

/// What a brick has left, and how far it is from losing more. The least slack is kept in lanes, because a
/// single running minimum of floats does not vectorize.
REAM_VECTOR_CLONES float compare_brick(const float* __restrict levels, const uint8_t* __restrict coverage,
                                       uint8_t* __restrict left) noexcept {
  constexpr int lanes = 16;
  float slack[lanes];
  for (float& s : slack) s = untouched_levels;
  for (int first = 0; first < brick_voxels; first += lanes)
    for (int k = 0; k < lanes; ++k) {
      const float level = levels[first + k];
      const float low = level < 0.0f ? 0.0f : level;
      const int kept = static_cast<int>(low > 255.0f ? 255.0f : low);
      const int before = coverage[first + k];
      const int after = kept < before ? kept : before;
      left[first + k] = static_cast<uint8_t>(after);
      const float above = after != 0 ? level - static_cast<float>(after) : untouched_levels;
      slack[k] = above < slack[k] ? above : slack[k];
    }
  float least = untouched_levels;
  for (const float s : slack) least = s < least ? s : least;
  return least;
}

class RemovalCpu final : public Removal {
 public:
  explicit RemovalCpu(const RemovalInput& input)
      : bone_(input.bone),
        classes_(voxel::class_table(input.bone.cortical_threshold_g_cc)),
        table_(profile_table(input.profile, coverage_levels_per_mm(bone_.grid))) {}

  bool cut(const QuantisedPose& grid_from_tool, std::span<const uint32_t> bricks,
           std::span<BrickOutcome> outcomes, RemovalSums& sums) noexcept override {
    sums = {};
    const GridAffine affine = tool_from_voxel(grid_from_tool, bone_.grid);
    for (size_t i = 0; i < bricks.size(); ++i) {
      alignas(64) float levels[brick_voxels];
      alignas(64) uint8_t left[brick_voxels];
      const size_t base = bone_.grid.brick_base(bricks[i]);
      uint8_t* coverage = bone_.coverage.data() + base;
      brick_levels(table_, affine, bone_.grid.brick_coordinates(bricks[i]) * brick_edge, levels);
      const float slack_levels = compare_brick(levels, coverage, left);
      const bool changed = apply(base, coverage, left, sums);
      outcomes[i] = {changed, slack_levels == untouched_levels, slack_levels};
      sums.changed_bricks += changed;
    }
    return true;
  }

 private:
  bool apply(size_t base, uint8_t* coverage, const uint8_t* left, RemovalSums& sums) const noexcept {
    bool any = false;
    for (size_t row = 0; row < brick_voxels; row += brick_edge) {
      if (std::memcmp(coverage + row, left + row, brick_edge) == 0) continue;
      any = true;
      for (size_t k = row; k < row + brick_edge; ++k) {
        if (left[k] == coverage[k]) continue;
        const auto bone_class = static_cast<size_t>(classes_[bone_.density[base + k]]);
        sums.coverage_removed[bone_class] += coverage[k] - left[k];
        sums.change_hash += mix64(change_key(base + k, left[k]));
      }
      std::memcpy(coverage + row, left + row, brick_edge);
    }
    return any;
  }

  voxel::BoneModel& bone_;
  std::array<voxel::BoneClass, 256> classes_;
  ProfileTable table_;
};

}  // namespace

std::unique_ptr<Removal> make_removal_cpu(const RemovalInput& input) {
  return std::make_unique<RemovalCpu>(input);
}

float coverage_levels_per_mm(const voxel::VoxelGrid& grid) {
  return static_cast<float>(255.0 / grid.min_spacing_mm());
}

}  // namespace ream::collide
