#pragma once
#include <memory>

#include "collide/bone_buffers.hpp"
#include "collide/contact/narrow_phase.hpp"

namespace ream::collide {

/// The narrow phase on an OpenCL device: the same sums as make_narrow_phase_cpu. Blocks are culled on the
/// host, the survivors' points are probed and summed on the device. Built, allocated and warmed here. Throws
/// Error unavailable.
std::unique_ptr<NarrowPhase> make_narrow_phase_cl(const NarrowPhaseInput& input,
                                                  std::shared_ptr<BoneBuffers> bone, LaunchShape shape);

}  // namespace ream::collide
