#pragma once
#include <string>

#include "record/ops.hpp"
#include "session/simulation/rig.hpp"

namespace ream::session {

/// What a recording says of a rig with a device before its first tick: enough to make the rig again from the
/// case, see recorded_rig.hpp. Takes about a nanosecond a voxel.
record::ops::Header header_of(const Rig& rig);

/// The segment that begins with the rig at `first_tick`, now. `reason`: start, resume or reamer.
record::ops::Segment segment_of(const Rig& rig, uint32_t first_tick, const std::string& reason);

/// JSON object with the hash of every table that a model reads: `feed`, where there is one, and `vibration`.
std::string table_hashes(const sim::Model& model);

}  // namespace ream::session
