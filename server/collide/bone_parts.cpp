#include "collide/bone_parts.hpp"

#include <bit>

#include "core/error.hpp"
#include "voxel/voxel_grid.hpp"

namespace ream::collide {
namespace {

constexpr size_t most_parts = 4;

}  // namespace

std::string BoneParts::build_options() const {
  return " -D PARTS=" + std::to_string(built()) + " -D PART_SHIFT=" + std::to_string(shift);
}

BoneParts bone_parts(size_t voxels, size_t largest_buffer_bytes, const std::string& device_name) {
  if (voxels <= largest_buffer_bytes) return {};
  const size_t part = std::bit_floor(largest_buffer_bytes);
  if (part < voxel::brick_voxels || voxels > most_parts * part)
    throw Error(ErrorKind::unavailable,
                "OpenCL: " + device_name + " allocates at most " + std::to_string(largest_buffer_bytes) +
                    " bytes at once, and the bone's " + std::to_string(voxels) + " voxels do not fit in " +
                    std::to_string(most_parts) + " parts of " + std::to_string(part) +
                    " bytes; use a coarser grid or --backend cpu");
  return {static_cast<int>((voxels + part - 1) / part), std::countr_zero(part)};
}

}  // namespace ream::collide
