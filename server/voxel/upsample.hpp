#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/vec.hpp"

namespace ream::voxel {

/// Largest factor for which all sums below stay within 31 bits.
inline constexpr int max_upsample_factor = 16;

/// Where output sample `i` of one axis lies between two input samples, exactly, in 1/(2 N) of an input voxel.
/// Its centre is at ((i + 0.5)/N - 0.5) = (2 i + 1 - N) / (2 N) input voxels. `low` and `high` are the input
/// samples beside it, clamped to the edge (so -1 becomes 0 and n becomes n - 1), and the value is
/// (low_weight * v[low] + high_weight * v[high]) / (2 N), with low_weight + high_weight = 2 N.
struct UpsampleTap {
  int low = 0, high = 0;
  uint32_t low_weight = 0, high_weight = 0;
};

/// Needs 0 <= i < input_count * factor. Worked example, N = 4, i = 0..4: numerators 2 i + 1 - N = -3, -1, 1,
/// 3, 5; floors by 8: -1, -1, 0, 0, 0; high weights 5, 7, 1, 3, 5.
constexpr UpsampleTap upsample_tap(int i, int factor, int input_count) {
  const int numerator = 2 * i + 1 - factor, unit = 2 * factor;
  const int base = (numerator + unit) / unit - 1;  // floor: numerator >= 1 - factor > -unit
  const auto high_weight = static_cast<uint32_t>(numerator - base * unit);
  return {base < 0 ? 0 : base, base + 1 < input_count ? base + 1 : input_count - 1,
          static_cast<uint32_t>(unit) - high_weight, high_weight};
}

/// Trilinear upsampling by `factor` (1 to max_upsample_factor) per axis of a volume of `dims` samples, x
/// fastest; the result has dims * factor samples. Arithmetic is unsigned 32-bit integers and exact until the
/// last step, so that any order of summation gives the same bits:
///   sum = sum over the 8 corners of weight_x * weight_y * weight_z * value     (weights of upsample_tap)
///   result = (sum + 4 N^3) / (8 N^3), rounded down, i.e. to nearest, halves up.
/// 16-bit samples take part as value + 32768 (0 to 65535) and the 32768 is taken off the result.
/// On two threads. Throws Error invalid_input for a bad factor, empty dims, or an input whose size is not
/// dims'.
std::vector<uint8_t> upsample_trilinear(std::span<const uint8_t> input, const Vec3i& dims, int factor);
std::vector<int16_t> upsample_trilinear(std::span<const int16_t> input, const Vec3i& dims, int factor);

}  // namespace ream::voxel
