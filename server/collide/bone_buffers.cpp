#include "collide/bone_buffers.hpp"

#include <algorithm>
#include <bit>

#include "core/error.hpp"
#include "voxel/voxel_grid.hpp"

namespace ream::collide {
namespace {

constexpr size_t max_parts = 4;

template <typename Byte>
std::vector<gpu::Buffer> in_parts(const gpu::Queue& queue, std::span<Byte> bytes, BoneParts parts) {
  std::vector<gpu::Buffer> buffers;
  for (int p = 0; p < parts.count; ++p) {
    const size_t from = static_cast<size_t>(p) << parts.shift;
    const size_t size = parts.count == 1 ? bytes.size() : size_t{1} << parts.shift;
    buffers.push_back(gpu::Buffer::over(queue, bytes.subspan(from, std::min(size, bytes.size() - from))));
  }
  while (buffers.size() < static_cast<size_t>(parts.built())) buffers.emplace_back(queue, 0);
  return buffers;
}

}  // namespace

std::string BoneParts::build_options() const {
  return " -D PARTS=" + std::to_string(built()) + " -D PART_SHIFT=" + std::to_string(shift);
}

BoneParts bone_parts(size_t voxels, size_t max_buffer_bytes, const std::string& device_name) {
  if (voxels <= max_buffer_bytes) return {};
  const size_t part = std::bit_floor(max_buffer_bytes);
  if (part < voxel::brick_voxels || voxels > max_parts * part)
    throw Error(ErrorKind::unavailable,
                "OpenCL: " + device_name + " allocates at most " + std::to_string(max_buffer_bytes) +
                    " bytes at once, and the bone's " + std::to_string(voxels) + " voxels do not fit in " +
                    std::to_string(max_parts) + " parts of " + std::to_string(part) +
                    " bytes; use a coarser grid or --backend cpu");
  return {static_cast<int>((voxels + part - 1) / part), std::countr_zero(part)};
}

LaunchShape LaunchShape::fitting(const gpu::Device& device) {
  return device.is_cpu ? LaunchShape{4, 1} : LaunchShape{256, 64};
}

BoneBuffers::BoneBuffers(const gpu::Device& device, voxel::BoneModel& session_bone,
                         std::optional<size_t> max_buffer_bytes)
    : bone(session_bone),
      queue(device),
      parts(bone_parts(bone.grid.voxel_count(), max_buffer_bytes.value_or(device.max_buffer_bytes),
                       device.name)),
      coverage(in_parts(queue, std::span<uint8_t>(bone.coverage), parts)),
      density(in_parts(queue, std::span<const uint8_t>(bone.density), parts)) {
  std::array<uint8_t, 256> codes{};
  const auto table = voxel::class_table(bone.cortical_threshold_g_cc);
  for (size_t i = 0; i < codes.size(); ++i) codes[i] = static_cast<uint8_t>(table[i]);
  classes = gpu::Buffer::copy_of(queue, std::span<const uint8_t>(codes));
}

}  // namespace ream::collide
