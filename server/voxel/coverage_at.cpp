#include "voxel/coverage_at.hpp"

namespace ream::voxel {

double coverage_at(const BoneModel& bone, const Vec3& point_mm) {
  return coverage_at(bone.grid, bone.coverage.data(), point_mm);
}

double coverage_at(const VoxelGrid& grid, const uint8_t* coverage, const Vec3& point_mm) {
  const Vec3 position = (point_mm.array() / grid.spacing_mm.array() - 0.5).matrix();
  const Vec3 low = position.array().floor().matrix();
  const Vec3i base = low.cast<int>();
  const Vec3 t = position - low;
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3i o(base.x() + (corner & 1), base.y() + ((corner >> 1) & 1), base.z() + (corner >> 2));
    if (!grid.contains(o)) continue;
    const double weight = ((corner & 1) ? t.x() : 1.0 - t.x()) * ((corner & 2) ? t.y() : 1.0 - t.y()) *
                          ((corner & 4) ? t.z() : 1.0 - t.z());
    sum += weight * coverage[grid.index(o)];
  }
  return sum;
}

}  // namespace ream::voxel
