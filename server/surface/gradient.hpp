#pragma once
#include <array>
#include <cstdint>
#include <cstring>

namespace ream::surface {

/// Eight samples of a row of x, or sums of them.
using Lanes = int16_t __attribute__((vector_size(16)));

inline Lanes load_lanes(const uint8_t* samples) {
  using Bytes = uint8_t __attribute__((vector_size(8)));
  Bytes bytes;
  std::memcpy(&bytes, samples, sizeof bytes);
  return __builtin_convertvector(bytes, Lanes);
}

/// Minus the gradient at a sample, times 32: central differences, averaged across with weights 1 2 1 because
/// a coverage that falls within one voxel is too steep for bare ones (they show rings on round surfaces).
/// `sample` has neighbours one row and one slice around it, and seven samples may be read from the one before
/// it on.
inline std::array<int, 3> fall_at(const uint8_t* sample, int row_bytes, int slice_bytes) {
  std::array<Lanes, 3> sum, fall_y;  // of the slices before, at and after the sample, weighted along y
  for (int z = 0; z < 3; ++z) {
    const uint8_t* row = sample - 1 + (z - 1) * slice_bytes;
    const Lanes before = load_lanes(row - row_bytes), at = load_lanes(row),
                after = load_lanes(row + row_bytes);
    sum[static_cast<size_t>(z)] = before + at + at + after;
    fall_y[static_cast<size_t>(z)] = before - after;
  }
  const Lanes along_x = sum[0] + sum[1] + sum[1] + sum[2];
  const Lanes along_y = fall_y[0] + fall_y[1] + fall_y[1] + fall_y[2];
  const Lanes along_z = sum[0] - sum[2];
  return {along_x[0] - along_x[2], along_y[0] + 2 * along_y[1] + along_y[2],
          along_z[0] + 2 * along_z[1] + along_z[2]};
}

}  // namespace ream::surface
