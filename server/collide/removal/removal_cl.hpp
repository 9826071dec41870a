#pragma once
#include <memory>

#include "collide/bone_buffers.hpp"
#include "collide/removal/decay.hpp"
#include "collide/removal/removal.hpp"

namespace ream::collide {

/// Removal on an OpenCL device: the same coverage, sums and hash as make_removal_cpu. On devices with memory
/// of their own the changed bricks come back in one read a batch of bricks. `bone` holds the bone of `input`.
/// Built, allocated and warmed here. Throws Error unavailable.
std::unique_ptr<Removal> make_removal_cl(const RemovalInput& input, std::shared_ptr<BoneBuffers> bone,
                                         LaunchShape shape);

/// A removal that may fail with bricks half cut, made to keep its promise: it remembers the listed bricks
/// before each cut and puts them back when `inner` failed. `bone` is the one that inner cuts.
std::unique_ptr<Removal> guarded(std::unique_ptr<Removal> inner, voxel::BoneModel& bone);

/// Decay whose points are looked up on an OpenCL device: the same coverage, sums and hash as make_decay_cpu.
/// `bone` holds the bone of `input`. Built, allocated and warmed here. Throws Error unavailable.
std::unique_ptr<Decay> make_decay_cl(const DecayInput& input, std::shared_ptr<BoneBuffers> bone,
                                     LaunchShape shape);

}  // namespace ream::collide
