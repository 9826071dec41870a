#include "collide/profile_table.hpp"

#include "collide/removal.hpp"
#include "core/vector_clones.hpp"

namespace ream::collide {

REAM_VECTOR_CLONES void brick_levels(const ProfileTable& shared_table, const GridAffine& shared_affine,
                                     float levels_per_mm, const Vec3i& first,
                                     float* __restrict levels) noexcept {
  constexpr int edge = voxel::brick_edge;
  // Copies, so that the compiler knows that stores do not change them.
  const ProfileTable table = shared_table;
  const GridAffine a = shared_affine;
  const float* __restrict entries = table.distance_mm;
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
        float r = (x * x + y * y) * table.inverse_r2_step;
        r = r < table.r2_limit ? r : table.r2_limit;
        float h = (z - table.z_min_mm) * table.inverse_z_step;
        h = h > 0.0f ? h : 0.0f;
        h = h < table.z_limit ? h : table.z_limit;
        const int ir = static_cast<int>(r), ih = static_cast<int>(h);
        const float tr = r - static_cast<float>(ir), th = h - static_cast<float>(ih);
        const int low = ih * table.r2_count + ir, high = low + table.r2_count;
        const float near_z = entries[low] + tr * (entries[low + 1] - entries[low]);
        const float far_z = entries[high] + tr * (entries[high + 1] - entries[high]);
        levels[u] = kept_level(near_z + th * (far_z - near_z), levels_per_mm);
      }
    }
}

}  // namespace ream::collide
