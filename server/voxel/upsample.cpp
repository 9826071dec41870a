#include "voxel/upsample.hpp"

#include <string>

#include "core/error.hpp"
#include "core/thread_pool.hpp"
#include "core/vector_clones.hpp"

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

/// Exact division by 8 N^3 of sums below 2^31, by a multiplication: the reciprocal is at most one unit of
/// 2^-47 too large, which shifts no quotient as 2^31 * 2^15 < 2^47.
struct Divisor {
  explicit Divisor(uint32_t whole) : reciprocal((uint64_t{1} << 47) / whole + 1) {}
  uint32_t operator()(uint32_t sum) const { return static_cast<uint32_t>((sum * reciprocal) >> 47); }
  uint64_t reciprocal;
};

/// What the rows of one call share.
template <typename T>
struct Volume {
  const T* input;
  size_t nx, ny;
  std::vector<UpsampleTap> tx, ty, tz;
  uint32_t half;
  Divisor divided;
};

/// Output sample x of all between two neighbouring input samples of a row.
template <typename T>
REAM_VECTOR_CLONES void stretch_row(const uint32_t* row, const UpsampleTap* taps, size_t count, uint32_t half,
                                    Divisor divided, T* out) {
  for (size_t i = 0; i < count; ++i) {
    const UpsampleTap& x = taps[i];
    unbias(divided(x.low_weight * row[x.low] + x.high_weight * row[x.high] + half), out[i]);
  }
}

/// The four input rows around an output row, summed with their weights.
template <typename T>
REAM_VECTOR_CLONES void sum_rows(const T* const rows[4], const uint32_t weights[4], size_t count,
                                 uint32_t* sum) {
  for (size_t u = 0; u < count; ++u)
    sum[u] = weights[0] * biased(rows[0][u]) + weights[1] * biased(rows[1][u]) +
             weights[2] * biased(rows[2][u]) + weights[3] * biased(rows[3][u]);
}

/// One output slice; one output row is the x-interpolation of the four input rows around it.
template <typename T>
void upsample_slice(const Volume<T>& v, const UpsampleTap& z, std::vector<uint32_t>& row, T* out) {
  for (const UpsampleTap& y : v.ty) {
    const auto source = [&](int at_v, int at_w) {
      return v.input + v.nx * (static_cast<size_t>(at_v) + v.ny * static_cast<size_t>(at_w));
    };
    const T* const rows[4] = {source(y.low, z.low), source(y.high, z.low), source(y.low, z.high),
                              source(y.high, z.high)};
    const uint32_t weights[4] = {y.low_weight * z.low_weight, y.high_weight * z.low_weight,
                                 y.low_weight * z.high_weight, y.high_weight * z.high_weight};
    sum_rows(rows, weights, v.nx, row.data());
    stretch_row(row.data(), v.tx.data(), v.tx.size(), v.half, v.divided, out);
    out += v.tx.size();
  }
}

void check(size_t size, const Vec3i& dims, int factor) {
  if (factor < 1 || factor > max_upsample_factor)
    throw Error(ErrorKind::invalid_input, "upsampling factor " + std::to_string(factor) +
                                              " must be from 1 to " + std::to_string(max_upsample_factor));
  if ((dims.array() <= 0).any())
    throw Error(ErrorKind::invalid_input, "a volume without voxels cannot be upsampled");
  const auto d = dims.cast<int64_t>().eval();
  if (static_cast<int64_t>(size) != d.x() * d.y() * d.z())
    throw Error(ErrorKind::invalid_input, "the volume to upsample does not have the size its dimensions say");
}

template <typename T>
std::vector<T> upsample(std::span<const T> input, const Vec3i& dims, int factor) {
  check(input.size(), dims, factor);
  const auto n = static_cast<uint32_t>(factor);
  const Volume<T> volume{input.data(),           static_cast<size_t>(dims.x()), static_cast<size_t>(dims.y()),
                         taps(dims.x(), factor), taps(dims.y(), factor),        taps(dims.z(), factor),
                         4 * n * n * n,          Divisor(8 * n * n * n)};
  const size_t slice = volume.tx.size() * volume.ty.size();
  std::vector<T> output(slice * volume.tz.size());
  parallel_for(2, volume.tz.size(), [&](size_t w) {
    std::vector<uint32_t> row(volume.nx);
    upsample_slice(volume, volume.tz[w], row, output.data() + w * slice);
  });
  return output;
}

}  // namespace

std::vector<uint8_t> upsample_trilinear(std::span<const uint8_t> input, const Vec3i& dims, int factor) {
  return upsample(input, dims, factor);
}

std::vector<int16_t> upsample_trilinear(std::span<const int16_t> input, const Vec3i& dims, int factor) {
  return upsample(input, dims, factor);
}

}  // namespace ream::voxel
