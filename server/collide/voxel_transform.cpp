#include "collide/voxel_transform.hpp"

namespace ream::collide {
namespace {

constexpr int fine_bits = 40, most_bits = 20, rotation_bits = 30;
constexpr int64_t reach_voxels = 128;  // how far outside the grid coordinates must still fit
constexpr double largest_factor = 32767.0;
constexpr double mm_per_nm = 1e-6;

int64_t rounded(double x) { return static_cast<int64_t>(x < 0.0 ? x - 0.5 : x + 0.5); }

constexpr double power_of_two(int exponent) {
  return exponent >= 0 ? static_cast<double>(int64_t{1} << exponent)
                       : 1.0 / static_cast<double>(int64_t{1} << -exponent);
}

int fitting_bits(const voxel::VoxelGrid& grid, double place_unit_mm) {
  int bits = most_bits;
  while ((grid.dims.maxCoeff() + reach_voxels) << bits > INT32_MAX) --bits;
  while (place_unit_mm / grid.min_spacing_mm() * power_of_two(bits) > largest_factor) --bits;
  return bits;
}

}  // namespace

VoxelTransform voxel_transform(const QuantisedPose& grid_from_tool, const voxel::VoxelGrid& grid,
                               double place_unit_mm) noexcept {
  VoxelTransform t;
  t.bits = fitting_bits(grid, place_unit_mm);
  for (size_t i = 0; i < 3; ++i) {
    const double spacing_mm = grid.spacing_mm[static_cast<Eigen::Index>(i)];
    const double units = place_unit_mm / spacing_mm;
    for (size_t j = 0; j < 3; ++j) {
      const auto r = static_cast<double>(grid_from_tool.rotation_q30[3 * i + j]);
      t.per_unit[3 * i + j] = static_cast<int32_t>(rounded(r * units * power_of_two(t.bits - rotation_bits)));
      t.fine[3 * i + j] = rounded(r * units * power_of_two(fine_bits - rotation_bits));
    }
    t.origin_fine[i] = rounded(static_cast<double>(grid_from_tool.translation_nm[i]) *
                               (mm_per_nm / spacing_mm) * power_of_two(fine_bits));
  }
  return t;
}

std::array<int32_t, 3> VoxelTransform::base(const Vec3i& o) const noexcept {
  std::array<int32_t, 3> result;
  for (size_t i = 0; i < 3; ++i)
    result[i] = static_cast<int32_t>(
        (fine[3 * i] * o.x() + fine[3 * i + 1] * o.y() + fine[3 * i + 2] * o.z() + origin_fine[i]) >>
        (fine_bits - bits));
  return result;
}

}  // namespace ream::collide
