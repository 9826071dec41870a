#include "voxel/bone_model.hpp"

#include <cmath>

#include "core/hash.hpp"

namespace ream::voxel {

uint8_t density_code(double density) {
  const double code = std::floor(density / density_step_g_cc + 0.5);
  return static_cast<uint8_t>(code < 0.0 ? 0.0 : code > max_density_code ? max_density_code : code);
}

double density_g_cc(uint8_t code) {
  return code == cartilage_code ? cartilage_density_g_cc : code * density_step_g_cc;
}

std::array<BoneClass, 256> class_table(double cortical_threshold_g_cc) {
  std::array<BoneClass, 256> table{};
  for (int code = 0; code < 256; ++code)
    table[static_cast<size_t>(code)] = code == cartilage_code ? BoneClass::cartilage
                                       : code * density_step_g_cc >= cortical_threshold_g_cc
                                           ? BoneClass::cortical
                                           : BoneClass::cancellous;
  return table;
}

int32_t first_cortical_code(double cortical_threshold_g_cc) {
  const auto table = class_table(cortical_threshold_g_cc);
  int32_t code = 0;
  while (code < cartilage_code && table[static_cast<size_t>(code)] != BoneClass::cortical) ++code;
  return code;
}

size_t BoneModel::filled_voxels() const {
  size_t filled = 0;
  for (const uint8_t c : coverage) filled += c >= 128;
  return filled;
}

uint64_t BoneModel::coverage_hash() const {
  uint64_t sum = 0;
  for (uint64_t i = 0; i < coverage.size(); ++i)  // 64 bits in a browser, too
    if (coverage[i] != 0) sum += mix64(i * 256 + coverage[i]);
  return sum;
}

BoneModel make_bone(const VoxelGrid& grid) {
  validate(grid);
  BoneModel bone;
  bone.grid = grid;
  bone.density = std::vector<uint8_t>(grid.voxel_count());
  bone.coverage.resize(grid.voxel_count());
  return bone;
}

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
