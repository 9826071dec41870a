#include "voxel/upsample.hpp"

#include <string>

#include "core/error.hpp"

namespace ream::voxel {
namespace {

uint32_t biased(uint8_t value) { return value; }
uint32_t biased(int16_t value) { return static_cast<uint32_t>(value + 32768); }
void unbias(uint32_t value, uint8_t& result) { result = static_cast<uint8_t>(value); }
void unbias(uint32_t value, int16_t& result) {
  result = static_cast<int16_t>(static_cast<int32_t>(value) - 32768);
}

std::vector<UpsampleTap> taps(int input_count, int factor) {
  std::vector<UpsampleTap> result(static_cast<size_t>(input_count) * static_cast<size_t>(factor));
  for (size_t i = 0; i < result.size(); ++i)
    result[i] = upsample_tap(static_cast<int>(i), factor, input_count);
  return result;
}

/// One output row is the x-interpolation of the four input rows around it, summed with their weights first.
template <typename T>
std::vector<T> upsample(std::span<const T> input, const Vec3i& dims, int factor) {
  check_upsample(input.size(), dims, factor);
  const auto nx = static_cast<size_t>(dims.x()), ny = static_cast<size_t>(dims.y());
  const auto tx = taps(dims.x(), factor), ty = taps(dims.y(), factor), tz = taps(dims.z(), factor);
  const auto n = static_cast<uint32_t>(factor);
  const uint32_t half = 4 * n * n * n, whole = 2 * half;
  std::vector<T> output(tx.size() * ty.size() * tz.size());
  std::vector<uint32_t> row(nx);
  T* out = output.data();
  for (const UpsampleTap& z : tz)
    for (const UpsampleTap& y : ty) {
      const auto source = [&](int v, int w) {
        return input.data() + nx * (static_cast<size_t>(v) + ny * static_cast<size_t>(w));
      };
      const T *ll = source(y.low, z.low), *hl = source(y.high, z.low), *lh = source(y.low, z.high),
              *hh = source(y.high, z.high);
      const uint32_t wll = y.low_weight * z.low_weight, whl = y.high_weight * z.low_weight,
                     wlh = y.low_weight * z.high_weight, whh = y.high_weight * z.high_weight;
      for (size_t u = 0; u < nx; ++u)
        row[u] = wll * biased(ll[u]) + whl * biased(hl[u]) + wlh * biased(lh[u]) + whh * biased(hh[u]);
      for (const UpsampleTap& x : tx) {
        const uint32_t sum =
            x.low_weight * row[static_cast<size_t>(x.low)] + x.high_weight * row[static_cast<size_t>(x.high)];
        unbias((sum + half) / whole, *out++);
      }
    }
  return output;
}

}  // namespace

void check_upsample(size_t size, const Vec3i& dims, int factor) {
  if (factor < 1 || factor > max_upsample_factor)
    throw Error(ErrorKind::invalid_input, "upsampling factor " + std::to_string(factor) +
                                              " must be from 1 to " + std::to_string(max_upsample_factor));
  if ((dims.array() <= 0).any())
    throw Error(ErrorKind::invalid_input, "a volume without voxels cannot be upsampled");
  const auto d = dims.cast<int64_t>().eval();
  if (static_cast<int64_t>(size) != d.x() * d.y() * d.z())
    throw Error(ErrorKind::invalid_input, "the volume to upsample does not have the size its dimensions say");
}

std::vector<uint8_t> upsample_trilinear(std::span<const uint8_t> input, const Vec3i& dims, int factor) {
  return upsample(input, dims, factor);
}

std::vector<int16_t> upsample_trilinear(std::span<const int16_t> input, const Vec3i& dims, int factor) {
  return upsample(input, dims, factor);
}

}  // namespace ream::voxel
