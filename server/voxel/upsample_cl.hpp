#pragma once
#include "gpu/queue.hpp"
#include "voxel/upsample.hpp"

namespace ream::voxel {

/// As upsample_trilinear, on an OpenCL device: the same bits, the same refusals. The output is made in slabs
/// of whole slices, so only the input must fit in one buffer of the device. Also throws Error unavailable.
std::vector<uint8_t> upsample_trilinear_cl(const gpu::Queue& queue, std::span<const uint8_t> input,
                                           const Vec3i& dims, int factor);
std::vector<int16_t> upsample_trilinear_cl(const gpu::Queue& queue, std::span<const int16_t> input,
                                           const Vec3i& dims, int factor);

}  // namespace ream::voxel
