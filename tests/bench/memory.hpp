#pragma once
#include "bench/our_contact.hpp"

namespace ream::bench {

/// Bytes that the product keeps for a session's bone: density and coverage, the follower's replica, and
/// everything kept a brick: what culls contact, the schedule of removal and the sender of bricks (the rings
/// apart, whose size is fixed). Density can be shared by sessions on one case; it is counted whole.
size_t memory_of(const OurBone& bone);

/// Bytes of coverage that lie in bricks that are wholly bone or wholly empty, where one bit would do until
/// removal touches them.
size_t coverage_in_uniform_bricks(const voxel::BoneModel& bone);

}  // namespace ream::bench
