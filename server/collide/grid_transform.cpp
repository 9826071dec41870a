#include "collide/grid_transform.hpp"

#include <algorithm>
#include <cassert>

#include "geometry/ordered_product.hpp"

namespace ream::collide {
namespace {

/// `min_bits`: of a place in its voxel that contact is judged by (collide/contact/surface_judge.hpp).
constexpr int fine_bits = 40, min_bits = 8, max_bits = 20, rotation_bits = 30;
constexpr int64_t reach_voxels = 128;  // how far outside the grid coordinates must still fit
constexpr double max_factor = 32767.0;
constexpr double mm_per_nm = 1e-6;
/// Of VoxelTransform::normal_rotation: bits of its fraction, and the largest, at which products with normals
/// still fit 16 bits once shifted.
constexpr int normal_bits = 7;
constexpr int64_t max_normal = 16384;

int64_t rounded(double x) { return static_cast<int64_t>(x < 0.0 ? x - 0.5 : x + 0.5); }

constexpr double power_of_two(int exponent) {
  return exponent >= 0 ? static_cast<double>(int64_t{1} << exponent)
                       : 1.0 / static_cast<double>(int64_t{1} << -exponent);
}

int fitting_bits(const voxel::VoxelGrid& grid, double place_unit_mm) {
  int bits = max_bits;
  while ((grid.dims.maxCoeff() + reach_voxels) << bits > INT32_MAX) --bits;
  while (place_unit_mm / grid.min_spacing_mm() * power_of_two(bits) > max_factor) --bits;
  return bits;
}

}  // namespace

GridAffine voxel_from_tool(const QuantisedPose& grid_from_tool, const voxel::VoxelGrid& grid) noexcept {
  const Pose pose = dequantised(grid_from_tool);
  GridAffine a{};
  for (int i = 0; i < 3; ++i) {
    const double voxels_per_mm = 1.0 / grid.spacing_mm[i];
    for (int j = 0; j < 3; ++j) a.m[3 * i + j] = static_cast<float>(pose.rotation(i, j) * voxels_per_mm);
    a.t[i] = static_cast<float>(pose.translation_mm[i] * voxels_per_mm);
  }
  return a;
}

GridAffine tool_from_voxel(const QuantisedPose& grid_from_tool, const voxel::VoxelGrid& grid) noexcept {
  const Pose pose = dequantised(grid_from_tool);
  GridAffine a{};
  for (int i = 0; i < 3; ++i) {
    double offset = 0.0;
    for (int j = 0; j < 3; ++j) {
      const double r = pose.rotation(j, i);
      a.m[3 * i + j] = static_cast<float>(r * grid.spacing_mm[j]);
      offset = offset + r * (0.5 * grid.spacing_mm[j] - pose.translation_mm[j]);
    }
    a.t[i] = static_cast<float>(offset);
  }
  return a;
}

VoxelTransform voxel_transform(const QuantisedPose& grid_from_tool, const voxel::VoxelGrid& grid,
                               double place_unit_mm) noexcept {
  VoxelTransform t;
  t.bits = fitting_bits(grid, place_unit_mm);
  assert(t.bits >= min_bits);
  for (size_t i = 0; i < 3; ++i) {
    const double spacing_mm = grid.spacing_mm[static_cast<Eigen::Index>(i)];
    const double units = place_unit_mm / spacing_mm;
    const double edges = spacing_mm / grid.min_spacing_mm() * power_of_two(normal_bits - rotation_bits);
    for (size_t j = 0; j < 3; ++j) {
      const auto r = static_cast<double>(grid_from_tool.rotation_q30[3 * i + j]);
      t.per_unit[3 * i + j] = static_cast<int32_t>(rounded(r * units * power_of_two(t.bits - rotation_bits)));
      t.normal_rotation[3 * i + j] =
          static_cast<int32_t>(std::clamp(rounded(r * edges), -max_normal, max_normal));
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

double Odometer::advance(const Pose& grid_from_tool) noexcept {
  double moved_mm = 0.0;
  // A point's way between two poses is linear in its place, so a corner of the box goes farthest.
  for (int i = 0; started_ && i < 8; ++i) {
    const Vec3 corner = box_.corner(i);
    moved_mm = std::max(
        moved_mm, length_bound(ordered_point(grid_from_tool, corner) - ordered_point(previous_, corner)));
  }
  started_ = true;
  previous_ = grid_from_tool;
  voxels_ = voxels_ + moved_mm / voxel_mm_;
  return voxels_;
}

}  // namespace ream::collide
