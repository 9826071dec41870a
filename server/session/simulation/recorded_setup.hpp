#pragma once
#include <string>

#include "record/recording.hpp"
#include "session/simulation/simulation.hpp"

namespace ream::session {

/// `found` under the recording's plan instead of its present one; its pilot hole is not cut yet. Errors:
/// conflict when it is not the case that was recorded; invalid_input for the plan.
case_::Case case_as_recorded(const record::Recording& recording, case_::Case found);

/// The plan of a recording. Error invalid_input.
case_::Plan recorded_plan(const record::Recording& recording);

/// What a recording says that its session is measured against. Error invalid_input.
case_::Anatomy anatomy_in(const record::Recording& recording);

/// Settings of a recording, to compute with `backend`. Error invalid_input.
sim::Settings recorded_settings(const record::Recording& recording, const std::string& backend);

/// Error conflict where the settings are of another physics: it cannot be computed again by this build.
void require_same_physics(const record::Recording& recording, const sim::Settings& settings);

/// The reamer of a segment. Error invalid_input.
Reamer recorded_reamer(const record::Recording& recording, const record::ops::Segment& segment);

/// A segment's simulation once more, without device or script. `bone_case` is the case_as_recorded(), its
/// coverage as the segment finds it; `from` likewise. Errors: those above; conflict for another physics; of
/// tool_of.
SimulationSetup recorded_setup(const record::Recording& recording, const record::ops::Segment& segment,
                               case_::Case bone_case, const sim::ResumeState& from,
                               const std::string& backend);

}  // namespace ream::session
