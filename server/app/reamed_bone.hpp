#pragma once
#include "case/case.hpp"
#include "record/recording.hpp"
#include "report/session_pictures.hpp"

namespace ream::app {

/// What a recording left of its bone, and how it compares with the plan. `bone_case`: recorded_case() of it.
/// Errors: conflict when the bone before tick 0 is not the recorded one; invalid_input for a damaged
/// recording or reamer.
report::ReamedBone reamed_bone(const record::Recording& recording, case_::Case bone_case);

}  // namespace ream::app
