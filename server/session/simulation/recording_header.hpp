#pragma once
#include <string>

#include "record/ops.hpp"
#include "session/simulation/simulation.hpp"

namespace ream::session {

/// What a recording says of a simulation with a device before its first tick: enough to make the simulation
/// again from the case, see recorded_setup.hpp. Takes about a nanosecond a voxel.
record::ops::Header header_of(const Simulation& simulation);

/// The segment that begins with the simulation at `first_tick`, now. `reason`: start, resume or reamer.
record::ops::Segment segment_of(const Simulation& simulation, uint32_t first_tick, const std::string& reason);

/// JSON object with the hash of every table that a model reads: `feed`, where there is one, and `vibration`.
std::string table_hashes(const sim::Model& model);

}  // namespace ream::session
