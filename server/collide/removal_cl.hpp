#pragma once
#include <memory>

#include "collide/bone_buffers.hpp"
#include "collide/removal.hpp"

namespace ream::collide {

/// Removal on an OpenCL device: the same coverage, sums and hash as make_removal_cpu. On devices with memory
/// of their own the changed bricks come back in one read a batch of bricks. `bone` holds the bone of `input`.
/// Built, allocated and warmed here. Throws Error unavailable.
std::unique_ptr<Removal> make_removal_cl(const RemovalInput& input, std::shared_ptr<BoneBuffers> bone,
                                         LaunchShape shape);

}  // namespace ream::collide
