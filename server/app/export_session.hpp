#pragma once
#include <filesystem>

#include "case/case.hpp"
#include "record/recording.hpp"

namespace ream::app {

/// Writes one row a tick, as the trace.csv of a run is; the same bytes. Errors: invalid_input at damage, io.
void export_trace(const record::Recording& recording, const std::filesystem::path& csv);

/// Writes the surface that the session left, world frame, mm, by brick deltas; as the reamed.ply of a run.
/// `bone_case`: of the recording, see case_of(); its coverage becomes the reamed one.
void export_surface(const record::Recording& recording, case_::Case& bone_case,
                    const std::filesystem::path& ply);

}  // namespace ream::app
