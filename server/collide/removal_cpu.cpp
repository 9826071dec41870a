#include <cstring>

#include "collide/profile_table.hpp"
#include "collide/removal.hpp"
#include "core/hash.hpp"
#include "voxel/bricks.hpp"

namespace ream::collide {
namespace {

using voxel::brick_edge;
using voxel::brick_voxels;

class RemovalCpu final : public Removal {
 public:
  explicit RemovalCpu(const RemovalInput& input)
      : bone_(input.bone),
        classes_(voxel::class_table(input.bone.cortical_threshold_g_cc)),
        table_(input.profile),
        levels_per_mm_(coverage_levels_per_mm(bone_.grid)) {}

  bool cut(const QuantisedPose& grid_from_tool, std::span<const uint32_t> bricks, std::span<uint8_t> changed,
           std::span<uint8_t> empty, RemovalSums& sums) noexcept override {
    sums = {};
    const GridAffine affine = tool_from_voxel(grid_from_tool, bone_.grid);
    for (size_t i = 0; i < bricks.size(); ++i) {
      alignas(64) uint8_t kept[brick_voxels];
      alignas(64) float distances_mm[brick_voxels];
      brick_distances_mm(table_, affine, bone_.grid.brick_coordinates(bricks[i]) * brick_edge, distances_mm);
      for (int k = 0; k < brick_voxels; ++k) kept[k] = kept_coverage(distances_mm[k], levels_per_mm_);
      const bool any = apply(bricks[i], kept, empty[i], sums);
      changed[i] = any;
      sums.changed_bricks += any;
    }
    return true;
  }

 private:
  bool apply(uint32_t brick, const uint8_t* kept, uint8_t& empty, RemovalSums& sums) noexcept {
    uint64_t left = 0;
    bool any = false;
    size_t at = bone_.grid.brick_base(brick);
    for (const size_t end = at + brick_voxels; at < end; at += brick_edge, kept += brick_edge) {
      uint64_t eight = 0;
      std::memcpy(&eight, bone_.coverage.data() + at, sizeof eight);
      if (eight != 0) any |= apply_row(at, kept, sums);
      std::memcpy(&eight, bone_.coverage.data() + at, sizeof eight);
      left |= eight;
    }
    empty = left == 0;
    return any;
  }

  bool apply_row(size_t at, const uint8_t* kept, RemovalSums& sums) noexcept {
    bool any = false;
    for (size_t u = 0; u < brick_edge; ++u) {
      uint8_t& coverage = bone_.coverage[at + u];
      if (kept[u] >= coverage) continue;
      const auto bone_class = static_cast<size_t>(classes_[bone_.density[at + u]]);
      sums.coverage_removed[bone_class] += coverage - kept[u];
      sums.change_hash += mix64(change_key(at + u, kept[u]));
      coverage = kept[u];
      any = true;
    }
    return any;
  }

  voxel::BoneModel& bone_;
  std::array<voxel::BoneClass, 256> classes_;
  ProfileTable table_;
  float levels_per_mm_;
};

}  // namespace

std::unique_ptr<Removal> make_removal_cpu(const RemovalInput& input) {
  return std::make_unique<RemovalCpu>(input);
}

float coverage_levels_per_mm(const voxel::VoxelGrid& grid) {
  return static_cast<float>(255.0 / grid.min_spacing_mm());
}

}  // namespace ream::collide
