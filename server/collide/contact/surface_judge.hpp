#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

namespace ream::collide {

/// How a point on the tool's cutting surface tells that it meets bone, in whole numbers. Coverage at bone's
/// surface is a ramp one voxel wide, and removal leaves such a ramp along what it has cut. So the point looks
/// at the one voxel of its column (along the grid axis nearest to its normal) whose centre lies in the ramp
/// that removal would leave here, and is engaged when that voxel holds as much bone as removal would leave of
/// it: contact begins where the two surfaces meet, and removal never clears its own contact.
///
/// The places of points within their voxels are taken in 1/256 voxel, normals in 1/127; both errors and those
/// of the removal's table stay below the tolerance.

/// Levels of coverage that a voxel may have less than removal would leave of it. 1/32 voxel.
inline constexpr int32_t judge_tolerance_levels = 8;

/// Fraction bits of a place within its voxel, and of the rotation's elements.
inline constexpr int judge_fraction_bits = 8, judge_rotation_bits = 7;

/// The level (128 plus the distance of the voxel's centre from the tool's surface in 255ths of the smallest
/// edge, outwards positive) of the voxel that holds a point, the step of the level to the next voxel along
/// the column, and where the column leads.
struct ColumnLevel {
  int32_t level = 0, step = 0;
  int axis = 0;
  int32_t outwards = 1;  ///< along the axis: 1 or -1
};

/// `rotation` is VoxelTransform::normal_rotation; `normal` in 1/127; `fraction` the place in the voxel in
/// 1/256. For normal 0 the level is 128 and the step 0.
constexpr ColumnLevel column_level(const std::array<int32_t, 9>& rotation,
                                   const std::array<int32_t, 3>& normal,
                                   const std::array<int32_t, 3>& fraction) noexcept {
  constexpr int32_t half = 1 << (judge_rotation_bits - 1);
  ColumnLevel column;
  int32_t along = 0, projected = half;
  for (size_t i = 0; i < 3; ++i) {
    const int32_t n = (rotation[3 * i] * normal[0] + rotation[3 * i + 1] * normal[1] +
                       rotation[3 * i + 2] * normal[2] + half) >>
                      judge_rotation_bits;
    along += n;
    projected += n * fraction[i];
    const int32_t step = 2 * (n < 0 ? -n : n);
    if (step <= column.step) continue;
    column.step = step;
    column.axis = static_cast<int>(i);
    column.outwards = n < 0 ? -1 : 1;
  }
  column.level = 128 + along - (projected >> judge_rotation_bits);
  return column;
}

/// Voxels to go outwards along the column to the one that is judged; adds their steps to the level.
constexpr int32_t moves_to_ramp(ColumnLevel& column) noexcept {
  const int32_t moves =
      column.level < 1 ? 1 : (column.level > 255 && column.level - column.step >= 1 ? -1 : 0);
  column.level += moves * column.step;
  return moves * column.outwards;
}

/// The least coverage that engages.
constexpr int32_t needed_coverage(int32_t level) noexcept {
  return std::max(1, std::min(level, 255) - judge_tolerance_levels);
}

}  // namespace ream::collide
