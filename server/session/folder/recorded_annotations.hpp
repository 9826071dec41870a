#pragma once
#include <filesystem>
#include <vector>

#include "record/recording.hpp"
#include "session/annotation.hpp"

namespace ream::session {

/// Remarks of a session that has ended, from the recording in its folder. None when it left no recording.
/// Errors: those of record::Recording.
std::vector<Annotation> recorded_annotations(const std::filesystem::path& folder);

/// Error not_found when the session left no recording, as one that was never started.
void require_recording(const std::filesystem::path& folder);
/// Error conflict when the recording is damaged before the end of the session: to write there would cut off
/// the rest.
void require_undamaged(const record::Recording& recording, const std::filesystem::path& folder);

/// Appends one to it, behind its end. Errors: conflict when a process has the session or the recording is
/// damaged; not_found when it left no recording; invalid_input when the remark is about a time beyond the
/// end; io, with nothing written.
Annotation annotate_recording(const std::filesystem::path& folder, const NewAnnotation& note);

/// Remarks of these authors are of nobody from here on, in a recording that is written anew. Errors: conflict
/// when a process has the session or the recording is damaged; io, with the old recording in its place.
void forget_authors(const std::filesystem::path& folder, const std::vector<std::string>& authors);

}  // namespace ream::session
