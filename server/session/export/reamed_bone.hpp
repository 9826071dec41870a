#pragma once
#include <filesystem>

#include "record/recording.hpp"
#include "report/session_pictures.hpp"
#include "score/metrics.hpp"

namespace ream::session {

/// What a recording left of its bone, and how it compares with plan and implant.
struct ComparedBone {
  report::ReamedBone bone;
  TriangleMesh implant;  ///< the seated one, grid frame; empty when none can be seated
};

/// `case_name` as for recorded_case(). `ticks`: accumulated() of the recording. Errors: those of
/// recorded_case(); conflict when the bone before tick 0 is not the recorded one; invalid_input for a damaged
/// recording or reamer.
ComparedBone reamed_bone(const record::Recording& recording, const score::MetricsAccumulator& ticks,
                         const std::string& case_name, const std::filesystem::path& data);

}  // namespace ream::session
