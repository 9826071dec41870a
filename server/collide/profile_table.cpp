#include "collide/profile_table.hpp"

#include <algorithm>
#include <cmath>

#include "core/vector_clones.hpp"

namespace ream::collide {
namespace {

constexpr double most_steps = 32767.0;

}  // namespace

ProfileTable profile_table(const shell::SweptProfile& profile, float levels_per_mm) {
  ProfileTable table;
  table.r2_count = profile.r2_count;
  table.z_min_mm = profile.z_min_mm;
  table.inverse_z_step = profile.inverse_z_step;
  table.inverse_r2_step = profile.inverse_r2_step;
  table.r2_limit = static_cast<float>(profile.r2_count) - 1.5f;
  table.z_limit = static_cast<float>(profile.z_count) - 1.5f;
  const double step_mm = std::exp2(std::ceil(std::log2(profile.margin_mm / most_steps)));
  table.levels_per_step = static_cast<float>(static_cast<double>(levels_per_mm) * step_mm);
  const auto steps = [&](size_t i) {
    const double exact = static_cast<double>(profile.distance_mm[i]) / step_mm;
    return static_cast<int>(std::lround(std::clamp(exact, -most_steps, most_steps)));
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

}  // namespace ream::collide
