#include "collide/removal/removal.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/hash.hpp"
#include "core/vector_clones.hpp"
#include "voxel/bricks.hpp"

namespace ream::collide {
namespace {

constexpr double max_steps = 32767.0;

using voxel::brick_edge;
using voxel::brick_voxels;

/// The least power of two that is no less; exact, so the same by every mathematics library.
double power_of_two_from(double x) {
  int exponent = 0;
  const double half_to_one = std::frexp(x, &exponent);
  return std::ldexp(1.0, half_to_one == 0.5 ? exponent - 1 : exponent);
}

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

ProfileTable profile_table(const shell::SweptProfile& profile, float levels_per_mm) {
  ProfileTable table;
  table.r2_count = profile.r2_count;
  table.z_min_mm = profile.z_min_mm;
  table.inverse_z_step = profile.inverse_z_step;
  table.inverse_r2_step = profile.inverse_r2_step;
  table.r2_limit = static_cast<float>(profile.r2_count) - 1.5f;
  table.z_limit = static_cast<float>(profile.z_count) - 1.5f;
  const double step_mm = power_of_two_from(profile.margin_mm / max_steps);
  table.levels_per_step = static_cast<float>(static_cast<double>(levels_per_mm) * step_mm);
  const auto steps = [&](size_t i) {
    const double exact = static_cast<double>(profile.distance_mm[i]) / step_mm;
    return static_cast<int>(std::lround(std::clamp(exact, -max_steps, max_steps)));
  };
  const size_t count = profile.distance_mm.size();
  table.pairs.reserve(count);
  for (size_t i = 0; i < count; ++i)
    table.pairs.push_back(steps(std::min(i + 1, count - 1)) * 65536 + (steps(i) & 65535));
  return table;
}

REAM_VECTOR_CLONES void brick_levels(const ProfileTable& table, const GridAffine& shared_affine,
                                     const Vec3i& first, float* __restrict levels) noexcept {
  constexpr int edge = voxel::brick_edge;
  // Copies, so that the compiler knows that stores do not change them.
  const GridAffine a = shared_affine;
  const int32_t* __restrict pairs = table.pairs.data();
  const int r2_count = table.r2_count;
  const float z_min_mm = table.z_min_mm, inverse_z_step = table.inverse_z_step,
              inverse_r2_step = table.inverse_r2_step, r2_limit = table.r2_limit, z_limit = table.z_limit,
              levels_per_step = table.levels_per_step;
  const int first_u = first.x();
  for (int w = 0; w < edge; ++w)
    for (int v = 0; v < edge; ++v, levels += edge) {
      const float fv = static_cast<float>(first.y() + v), fw = static_cast<float>(first.z() + w);
      const float row_x = a.m[2] * fw + a.m[1] * fv + a.t[0];
      const float row_y = a.m[5] * fw + a.m[4] * fv + a.t[1];
      const float row_z = a.m[8] * fw + a.m[7] * fv + a.t[2];
      for (int u = 0; u < edge; ++u) {
        const float fu = static_cast<float>(first_u + u);
        const float x = a.m[0] * fu + row_x, y = a.m[3] * fu + row_y, z = a.m[6] * fu + row_z;
        float r = (x * x + y * y) * inverse_r2_step;
        r = r < r2_limit ? r : r2_limit;
        float h = (z - z_min_mm) * inverse_z_step;
        h = h > 0.0f ? h : 0.0f;
        h = h < z_limit ? h : z_limit;
        const int ir = static_cast<int>(r), ih = static_cast<int>(h);
        const float tr = r - static_cast<float>(ir), th = h - static_cast<float>(ih);
        const int at = ih * r2_count + ir;
        const int32_t near_pair = pairs[at], far_pair = pairs[at + r2_count];
        const float near_0 = static_cast<float>(near_pair << 16 >> 16),
                    near_1 = static_cast<float>(near_pair >> 16);
        const float far_0 = static_cast<float>(far_pair << 16 >> 16),
                    far_1 = static_cast<float>(far_pair >> 16);
        const float near_z = near_0 + tr * (near_1 - near_0);
        const float far_z = far_0 + tr * (far_1 - far_0);
        levels[u] = (near_z + th * (far_z - near_z)) * levels_per_step + 128.0f;
      }
    }
}

std::unique_ptr<Removal> make_removal_cpu(const RemovalInput& input) {
  return std::make_unique<RemovalCpu>(input);
}

float coverage_levels_per_mm(const voxel::VoxelGrid& grid) {
  return static_cast<float>(255.0 / grid.min_spacing_mm());
}

}  // namespace ream::collide
