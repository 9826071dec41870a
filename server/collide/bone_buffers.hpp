#pragma once
#include <array>
#include <memory>

#include "gpu/buffer.hpp"
#include "voxel/bone_model.hpp"

namespace ream::collide {

/// How many work-groups of how many work-items the tick's kernels run with. One shape for the whole session,
/// so that everything is compiled before the first tick; results do not depend on it.
struct LaunchShape {
  int groups = 0, lanes = 0;
  /// CPUs run work-items as loops: few groups of one lane. Others: enough groups of 64 lanes to fill them.
  static LaunchShape fitting(const gpu::Device& device);
};

/// One session's bone on an OpenCL device, and the queue that works on it: the host's own arrays where the
/// device shares memory, copies elsewhere. Narrow phase and removal of a session share one of these, so that
/// contact sees what removal cut. `bone` must outlive it and stay where it is.
struct BoneBuffers {
  /// Throws Error unavailable when the device fails or the bone is too large for it (2^32 voxels, or its
  /// buffer limit).
  BoneBuffers(const gpu::Device& device, voxel::BoneModel& bone);

  voxel::BoneModel& bone;
  gpu::Queue queue;
  gpu::Buffer coverage, density;
  gpu::Buffer classes;  ///< bone class of each density code, one byte each
};

}  // namespace ream::collide
