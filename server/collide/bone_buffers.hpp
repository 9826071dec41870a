#pragma once
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "collide/bone_parts.hpp"
#include "gpu/buffer.hpp"
#include "voxel/bone_model.hpp"

namespace ream::collide {

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
  /// of the bone gets larger than `largest_buffer_bytes`; the device's own limit unless a test says less.
  BoneBuffers(const gpu::Device& device, voxel::BoneModel& bone,
              std::optional<size_t> largest_buffer_bytes = {});

  /// True where kernels work on the host's own arrays.
  bool shared() const { return coverage.front().shared(); }

  voxel::BoneModel& bone;
  gpu::Queue queue;
  BoneParts parts;
  std::vector<gpu::Buffer> coverage, density;  ///< parts.built() each
  gpu::Buffer classes;                         ///< bone class of each density code, one byte each
};

}  // namespace ream::collide
