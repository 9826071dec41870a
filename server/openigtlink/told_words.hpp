#pragma once
#include "openigtlink/board.hpp"
#include "openigtlink/showcase.hpp"
#include "stream/telemetry.hpp"

namespace ream::openigtlink {

/// Puts what a session is, once for each: STRING "Session" and POLYDATA "Reamer" (tool frame: it belongs
/// under "ReamerToRas").
void tell_session(const ShownSession& session, int64_t unix_ns, Board& board);

/// What the board says already.
struct AlreadyTold {
  std::string status;
  bool bone_moved = false;
};

/// Puts what one tick was: TRANSFORM "ReamerToRas" (the tool's frame: origin at the apex, z into the bone)
/// and, where the bone has moved from where its surface has it, "BoneToRas"; SENSOR "Force", N: simulated
/// thrust along the tool's z, magnitude of the force on the hand; SENSOR "Torque", N m: magnitude of the
/// moment about the tool's origin; STATUS "Simulator" when it has changed.
void tell_tick(const stream::TelemetrySample& tick, int64_t unix_ns, AlreadyTold& told, Board& board);

/// STATUS "Simulator" while no session has been started.
void tell_nothing_runs(int64_t unix_ns, Board& board);

}  // namespace ream::openigtlink
