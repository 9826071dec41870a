#pragma once
#include <filesystem>

#include "api/export_formats.hpp"
#include "case/case.hpp"
#include "record/recording.hpp"

namespace ream::app {

/// Writes one row a tick, as the trace.csv of a run is; the same bytes. Of a part: the rows of every
/// `stride`th tick from the first one in it, as they stand in the whole. Errors: invalid_input at damage, io.
void export_trace(const record::Recording& recording, const std::filesystem::path& csv,
                  const api::TracePart& part = {}, const Progress& progress = no_progress);

/// Writes the surface that the session left, world frame, by brick deltas, in the form that the ending of
/// `path` says (geometry/mesh_export.hpp); as PLY it is the reamed.ply of a run. `bone_case`: of the
/// recording, see case_of(); its coverage becomes the reamed one.
void export_surface(const record::Recording& recording, case_::Case& bone_case,
                    const std::filesystem::path& path, const Progress& progress = no_progress);

/// Writes a picture of the same, as the snapshot.png of a run.
void export_picture(const record::Recording& recording, case_::Case& bone_case,
                    const std::filesystem::path& png, const Progress& progress = no_progress);

/// The forms in which a server exports the sessions of a data folder.
api::ExportFormats export_formats(const std::filesystem::path& data);

}  // namespace ream::app
