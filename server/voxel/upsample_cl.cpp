#include "voxel/upsample_cl.hpp"

#include <algorithm>

#include "gpu/program.hpp"
#include "kernels/layout.h"

namespace ream::voxel {
namespace {

constexpr size_t slab_bytes = size_t{256} << 20;
constexpr size_t local_size = 64;

gpu::Buffer taps(const gpu::Queue& queue, int input_count, int factor) {
  std::vector<layout::UpsampleTapLayout> table;
  for (int i = 0; i < input_count * factor; ++i) {
    const UpsampleTap tap = upsample_tap(i, factor, input_count);
    table.push_back({tap.low, tap.high, tap.low_weight, tap.high_weight});
  }
  return gpu::Buffer::copy_of(queue, std::span(table));
}

template <typename T>
std::vector<T> upsample(const gpu::Queue& queue, std::span<const T> input, const Vec3i& dims, int factor,
                        const std::string& options) {
  check_upsample(input.size(), dims, factor);
  const gpu::Program program(queue, "upsample.cl", options);
  gpu::Kernel kernel(program, "upsample_trilinear");
  const gpu::Buffer source = gpu::Buffer::over(queue, input);
  const gpu::Buffer tx = taps(queue, dims.x(), factor), ty = taps(queue, dims.y(), factor),
                    tz = taps(queue, dims.z(), factor);
  const auto size = (dims * factor).cast<uint32_t>().eval();
  const auto n = static_cast<uint32_t>(factor);
  layout::UpsampleArguments arguments{static_cast<uint32_t>(dims.x()),
                                      static_cast<uint32_t>(dims.y()),
                                      size.x(),
                                      size.y(),
                                      0,
                                      4 * n * n * n,
                                      8 * n * n * n};
  const size_t slice = static_cast<size_t>(size.x()) * size.y();
  const size_t slices_a_slab = std::max<size_t>(1, slab_bytes / (slice * sizeof(T)));
  std::vector<T> output(slice * size.z());
  for (size_t first = 0; first < size.z(); first += slices_a_slab) {
    const size_t slices = std::min<size_t>(slices_a_slab, size.z() - first);
    const std::span<T> slab = std::span(output).subspan(first * slice, slices * slice);
    const gpu::Buffer target = gpu::Buffer::over(queue, slab);
    arguments.first_slice = static_cast<uint32_t>(first);
    kernel.set_all(source, tx, ty, tz, arguments, target);
    kernel.enqueue(queue, size.x(), local_size, slices * size.y());
    queue.finish();
    if (!target.shared()) target.read(queue, slab.data(), slab.size_bytes());
  }
  return output;
}

}  // namespace

std::vector<uint8_t> upsample_trilinear_cl(const gpu::Queue& queue, std::span<const uint8_t> input,
                                           const Vec3i& dims, int factor) {
  return upsample(queue, input, dims, factor, "-D SAMPLE=uchar -D BIAS=0");
}

std::vector<int16_t> upsample_trilinear_cl(const gpu::Queue& queue, std::span<const int16_t> input,
                                           const Vec3i& dims, int factor) {
  return upsample(queue, input, dims, factor, "-D SAMPLE=short -D BIAS=32768");
}

}  // namespace ream::voxel
