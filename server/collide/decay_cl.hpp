#pragma once
#include <memory>

#include "collide/bone_buffers.hpp"
#include "collide/decay.hpp"

namespace ream::collide {

/// Decay whose points are looked up on an OpenCL device: the same coverage, sums and hash as make_decay_cpu.
/// `bone` holds the bone of `input`. Built, allocated and warmed here. Throws Error unavailable.
std::unique_ptr<Decay> make_decay_cl(const DecayInput& input, std::shared_ptr<BoneBuffers> bone,
                                     LaunchShape shape);

}  // namespace ream::collide
