#pragma once
#include <filesystem>
#include <string>

#include "app/rig.hpp"
#include "record/recording.hpp"

namespace ream::app {

/// The case that a recording began with, under the recording's plan instead of the case's present one; its
/// pilot hole is not cut yet. `case_name` as in RunRequest, or empty for the case that the header names.
/// Errors: not_found, conflict when it is not the same case any more, invalid_input for the plan.
case_::Case recorded_case(const record::Recording& recording, const std::string& case_name,
                          const std::filesystem::path& data);

/// The plan of a recording. Error invalid_input.
case_::Plan recorded_plan(const record::Recording& recording);

/// What a recording's session is measured against; recordings of older revisions do not say it, so that it is
/// what `native`, their case, says now. `case_name` as above. Error invalid_input.
case_::Anatomy recorded_anatomy(const record::Recording& recording, const case_::Case& native,
                                const std::string& case_name, const std::filesystem::path& data);

/// Settings of a recording, to compute with `backend`. Error invalid_input.
sim::Settings recorded_settings(const record::Recording& recording, const std::string& backend);

/// The reamer of a segment. Error invalid_input.
Reamer recorded_reamer(const record::Recording& recording, const record::ops::Segment& segment);

/// A segment's rig once more, without device or script. `bone_case` is the recorded_case, its coverage as the
/// segment finds it; `from` likewise. Errors: those above; of tool_of.
RigParts recorded_parts(const record::Recording& recording, const record::ops::Segment& segment,
                        case_::Case bone_case, const sim::CarriedOn& from, const std::string& backend);

}  // namespace ream::app
