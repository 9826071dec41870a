#pragma once
#include <filesystem>
#include <vector>

#include "api/annotation.hpp"

namespace ream::api {

/// Remarks of a session that has ended, from the recording in its folder. None when it left no recording.
/// Errors: those of record::Recording.
std::vector<Annotation> recorded_annotations(const std::filesystem::path& folder);

/// Appends one to it, behind its end. Errors: conflict when a process has the session; not_found when it left
/// no recording; invalid_input when the remark is about a time beyond the end; io, with nothing written.
Annotation annotate_recording(const std::filesystem::path& folder, const NewAnnotation& note);

}  // namespace ream::api
