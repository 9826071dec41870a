#pragma once
#include <memory>
#include <optional>

#include "case/case.hpp"
#include "record/recording.hpp"
#include "record/tick_difference.hpp"
#include "score/native_glenoid.hpp"

namespace ream::session {

/// What a recording says happened.
struct Review {
  uint32_t ticks = 0;
  double removed_volume_mm3 = 0.0;
  std::optional<double>
      reaming_depth_mm;  ///< of that bone; empty where nothing tells what it is measured against
  uint64_t session_hash = 0;
  uint64_t grid_hash = 0;    ///< of the bone with all brick deltas up to the last moment before `ticks`
  uint32_t grid_ticks = 0;   ///< that moment
  uint32_t checkpoints = 0;  ///< that were compared
  std::optional<record::Difference>
      difference;  ///< of the deltas from a checkpoint, in tick `difference_tick`
  uint32_t difference_tick = 0;
};

/// Goes through a recording by its brick deltas alone, up to `until_tick`, and compares them with its
/// checkpoints. `bone_case` is the recorded_case, `native` its recorded_glenoid or null. Errors: conflict
/// when the bone before tick 0 is not the recorded one; invalid_input for a damaged chunk; io when
/// interrupted.
Review review_recording(const record::Recording& recording, case_::Case bone_case,
                        const std::shared_ptr<const score::NativeGlenoid>& native, uint32_t until_tick);

}  // namespace ream::session
