#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "record/tick_difference.hpp"
#include "session/simulation/recorded_setup.hpp"

namespace ream::session {

/// How a recording is computed again.
struct VerifyRequest {
  std::string backend = "cpu";       ///< auto, cpu, opencl or opencl:N
  uint32_t until_tick = UINT32_MAX;  ///< so many ticks, or all there are
  /// Between two looks at the whole bone, a nanosecond a voxel each; by default as often as there are keys.
  uint32_t ticks_between_grid_hashes = 16000;
  Progress progress = no_progress;
};

/// What came of it.
struct VerifyResult {
  uint32_t ticks = 0;                            ///< that are as they were recorded, from the first on
  std::string backend;                           ///< that computed, for people
  uint64_t session_hash = 0, grid_hash = 0;      ///< after the last tick that was computed
  std::optional<record::Difference> difference;  ///< in tick `ticks`; empty: everything is the same
  std::vector<std::string> left_out;             ///< sentences on what could not be compared
};

/// Computes every segment of a recording once more from its recorded causes and compares each tick's pose,
/// bone, forces and hash, and the whole bone's hash where the recording has keys and at its end. Stops at the
/// first tick that differs. `bone_case` is the recorded_case. Errors: those of recorded_setup and Simulation;
/// invalid_input for a damaged chunk; io when interrupted.
VerifyResult verify_replay(const record::Recording& recording, case_::Case bone_case,
                           const VerifyRequest& request);

/// One line: the tick, its time, what differs, what was recorded and what was found.
std::string difference_words(uint32_t tick, const record::Difference& difference);

}  // namespace ream::session
