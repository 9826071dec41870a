#include "collide/bone_buffers.hpp"

#include <limits>

#include "core/error.hpp"

namespace ream::collide {

LaunchShape LaunchShape::fitting(const gpu::Device& device) {
  return device.is_cpu ? LaunchShape{16, 1} : LaunchShape{256, 64};
}

BoneBuffers::BoneBuffers(const gpu::Device& device, voxel::BoneModel& session_bone)
    : bone(session_bone), queue(device) {
  if (bone.grid.voxel_count() >= std::numeric_limits<uint32_t>::max())
    throw Error(ErrorKind::unavailable, "OpenCL: the bone has 2^32 voxels or more; use --backend cpu");
  coverage = gpu::Buffer::over(queue, std::span(bone.coverage));
  density = gpu::Buffer::over(queue, std::span(bone.density));
  std::array<uint8_t, 256> codes{};
  const auto table = voxel::class_table(bone.cortical_threshold_g_cc);
  for (size_t i = 0; i < codes.size(); ++i) codes[i] = static_cast<uint8_t>(table[i]);
  classes = gpu::Buffer::copy_of(queue, std::span<const uint8_t>(codes));
}

}  // namespace ream::collide
