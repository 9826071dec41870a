#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "gpu/buffer.hpp"
#include "voxel/bone_model.hpp"

namespace ream::collide {

/// How a bone's bytes, one a voxel, are laid out in a device's buffers: part p has the voxels from p << shift
/// on, in the order of VoxelGrid::index, at most 1 << shift of them. Parts are whole bricks.
struct BoneParts {
  int count = 1;  ///< 1 to 4 that hold voxels
  int shift = 0;  ///< 0 where there is one part only

  /// Numbers of parts that kernels are built for: 1, 2 or 4; where three hold voxels the fourth is there but
  /// empty.
  int built() const { return count == 3 ? 4 : count; }
  /// Compiler options for the kernels that include kernels/bone_parts.h, like " -D PARTS=2 -D PART_SHIFT=30".
  std::string build_options() const;
};

/// The fewest parts that fit a device: one where `max_buffer_bytes` (the largest it allocates at
/// once) allows, else as many as are needed of the largest power of two below it. Throws Error unavailable,
/// naming the device, where four are not enough.
BoneParts bone_parts(size_t voxels, size_t max_buffer_bytes, const std::string& device_name);

/// How many work-groups of how many work-items the tick's kernels run with. One shape for the whole session,
/// so that everything is compiled before the first tick; results do not depend on it.
struct LaunchShape {
  int groups = 0, lanes = 0;
  /// CPUs run work-items as loops: few groups of one lane, for each has sums of its own to add up. Others:
  /// enough groups of 64 lanes to fill them.
  static LaunchShape fitting(const gpu::Device& device);
};

/// One session's bone on an OpenCL device, and the queue that works on it: the host's own arrays where the
/// device shares memory, copies elsewhere; in parts where it does not allocate as much at once. Narrow phase
/// and removal of a session share one of these, so that contact sees what removal cut. `bone` must outlive it
/// and stay where it is.
struct BoneBuffers {
  /// Throws Error unavailable when the device fails or the bone is too large for it (bone_parts). No buffer
  /// of the bone gets larger than `max_buffer_bytes`; the device's own limit unless a test says less.
  BoneBuffers(const gpu::Device& device, voxel::BoneModel& bone, std::optional<size_t> max_buffer_bytes = {});

  /// True where kernels work on the host's own arrays.
  bool shared() const { return coverage.front().shared(); }

  voxel::BoneModel& bone;
  gpu::Queue queue;
  BoneParts parts;
  std::vector<gpu::Buffer> coverage, density;  ///< parts.built() each
  gpu::Buffer classes;                         ///< bone class of each density code, one byte each
};

}  // namespace ream::collide
