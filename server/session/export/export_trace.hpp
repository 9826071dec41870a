#pragma once
#include <filesystem>

#include "core/progress.hpp"
#include "record/recording.hpp"
#include "session/export/export_formats.hpp"

namespace ream::session {

/// Writes one row a tick, as the trace.csv of a run is; the same bytes. Of a part: the rows of every
/// `stride`th tick from the first one in it, as they stand in the whole. Errors: invalid_input at damage, io.
void export_trace(const record::Recording& recording, const std::filesystem::path& csv,
                  const TracePart& part = {}, const Progress& progress = no_progress);

}  // namespace ream::session
