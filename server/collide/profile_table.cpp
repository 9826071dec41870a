#include "collide/profile_table.hpp"

namespace ream::collide {

__attribute__((target_clones("avx512f", "avx2", "default"))) void brick_distances_mm(
    const ProfileTable& shared_table, const GridAffine& a, const Vec3i& first, float* __restrict distances_mm) noexcept {
  constexpr int edge = voxel::brick_edge;
  const ProfileTable table = shared_table;  // its own copy, so that stores are known not to change it
  for (int w = 0; w < edge; ++w)
    for (int v = 0; v < edge; ++v, distances_mm += edge) {
      const float fv = static_cast<float>(first.y() + v), fw = static_cast<float>(first.z() + w);
      const float row_x = a.m[2] * fw + a.m[1] * fv + a.t[0];
      const float row_y = a.m[5] * fw + a.m[4] * fv + a.t[1];
      const float row_z = a.m[8] * fw + a.m[7] * fv + a.t[2];
      for (int u = 0; u < edge; ++u) {
        const float fu = static_cast<float>(first.x() + u);
        distances_mm[u] = table.at(a.m[0] * fu + row_x, a.m[3] * fu + row_y, a.m[6] * fu + row_z);
      }
    }
}

}  // namespace ream::collide
