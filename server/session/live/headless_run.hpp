#pragma once
#include <filesystem>
#include <span>

#include "core/progress.hpp"
#include "session/live/session_files.hpp"

namespace ream::session {

/// Runs the simulation to the end of its script in virtual time (or at 1 kHz when `wall_clock`) and writes
/// metrics.json, timing.json, session.json, trace.csv and recording.ream into `folder`. `start_coverage` is a
/// copy of the bone's coverage before the first tick. Errors: io;
/// unavailable for a fault of the loop (a black box is left in the working folder); interrupted; those of
/// `progress`.
SessionFiles::Results run_headless(Simulation& simulation, std::span<const uint8_t> start_coverage,
                                   const std::filesystem::path& folder, bool wall_clock,
                                   const Progress& progress = no_progress);

}  // namespace ream::session
