#include <cstring>

#include "collide/removal.hpp"
#include "core/hash.hpp"
#include "voxel/bricks.hpp"

namespace ream::collide {
namespace {

using voxel::brick_edge;
using voxel::brick_voxels;

/// The table and the constants of one call, as plain values so that the inner loop keeps them in registers.
struct ProfileTable {
  const float* distance_mm;
  int r2_count;
  float z_min_mm, inverse_z_step, inverse_r2_step, levels_per_mm;
  float r2_limit, z_limit;  ///< last usable table coordinates; beyond them the distance exceeds half a voxel anyway
};

/// Coverage that each voxel of one brick may keep. The order of operations is that of kernels/removal.cl. Table
/// coordinates are clamped: the table's margin is wider than half a voxel, so its border keeps everything.
__attribute__((target_clones("avx512f", "avx2", "default"))) void kept_in_brick(
    const ProfileTable& table, const GridAffine& a, const Vec3i& first, uint8_t* kept) {
  for (int w = 0; w < brick_edge; ++w)
    for (int v = 0; v < brick_edge; ++v, kept += brick_edge) {
      const float fv = static_cast<float>(first.y() + v), fw = static_cast<float>(first.z() + w);
      const float row_x = a.m[2] * fw + a.m[1] * fv + a.t[0];
      const float row_y = a.m[5] * fw + a.m[4] * fv + a.t[1];
      const float row_z = a.m[8] * fw + a.m[7] * fv + a.t[2];
      for (int u = 0; u < brick_edge; ++u) {
        const float fu = static_cast<float>(first.x() + u);
        const float x = a.m[0] * fu + row_x, y = a.m[3] * fu + row_y, z = a.m[6] * fu + row_z;
        float r = (x * x + y * y) * table.inverse_r2_step;
        r = r < table.r2_limit ? r : table.r2_limit;
        float h = (z - table.z_min_mm) * table.inverse_z_step;
        h = h > 0.0f ? h : 0.0f;
        h = h < table.z_limit ? h : table.z_limit;
        const int ir = static_cast<int>(r), ih = static_cast<int>(h);
        const float tr = r - static_cast<float>(ir), th = h - static_cast<float>(ih);
        const float* low = table.distance_mm + ih * table.r2_count + ir;
        const float* high = low + table.r2_count;
        const float near_z = low[0] + tr * (low[1] - low[0]);
        const float far_z = high[0] + tr * (high[1] - high[0]);
        kept[u] = kept_coverage(near_z + th * (far_z - near_z), table.levels_per_mm);
      }
    }
}

class RemovalCpu final : public Removal {
 public:
  explicit RemovalCpu(const RemovalInput& input)
      : profile_(input.profile),
        bone_(input.bone),
        classes_(voxel::class_table(input.bone.cortical_threshold_g_cc)),
        table_{profile_.distance_mm.data(),
               profile_.r2_count,
               profile_.z_min_mm,
               profile_.inverse_z_step,
               profile_.inverse_r2_step,
               coverage_levels_per_mm(bone_.grid),
               static_cast<float>(profile_.r2_count) - 1.5f,
               static_cast<float>(profile_.z_count) - 1.5f} {}

  bool cut(const QuantisedPose& grid_from_tool, std::span<const uint32_t> bricks, std::span<uint8_t> changed,
           std::span<uint8_t> empty, RemovalSums& sums) noexcept override {
    sums = {};
    const GridAffine affine = tool_from_voxel(grid_from_tool, bone_.grid);
    for (size_t i = 0; i < bricks.size(); ++i) {
      alignas(64) uint8_t kept[brick_voxels];
      kept_in_brick(table_, affine, bone_.grid.brick_coordinates(bricks[i]) * brick_edge, kept);
      const bool any = apply(bricks[i], kept, empty[i], sums);
      changed[i] = any;
      sums.changed_bricks += any;
    }
    return true;
  }

 private:
  bool apply(uint32_t brick, const uint8_t* kept, uint8_t& empty, RemovalSums& sums) noexcept {
    const size_t base = bone_.grid.brick_base(brick);
    const size_t row = static_cast<size_t>(bone_.grid.dims.x()), slice = row * static_cast<size_t>(bone_.grid.dims.y());
    uint64_t left = 0;
    bool any = false;
    for (size_t w = 0; w < brick_edge; ++w)
      for (size_t v = 0; v < brick_edge; ++v, kept += brick_edge) {
        const size_t at = base + w * slice + v * row;
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

  const shell::SweptProfile& profile_;
  voxel::BoneModel& bone_;
  std::array<voxel::BoneClass, 256> classes_;
  ProfileTable table_;
};

}  // namespace

std::unique_ptr<Removal> make_removal_cpu(const RemovalInput& input) { return std::make_unique<RemovalCpu>(input); }

float coverage_levels_per_mm(const voxel::VoxelGrid& grid) { return static_cast<float>(255.0 / grid.min_spacing_mm()); }

}  // namespace ream::collide
