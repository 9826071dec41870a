#pragma once
#include <filesystem>
#include <string>

#include "core/progress.hpp"
#include "session/running_session.hpp"

namespace ream::session {

/// A session and its case as one file, to be looked at, rescored and proven on another machine: bundle.json,
/// session/ (the session's folder) and case/ (the case's).

/// Writes it. `recording` as recording_path() finds it, `case_name` as for case_of(). `labels`: what it says
/// of trainee and title in place of session.json; null: as it is there. Errors: those of the recording and
/// its case; io.
void write_session_bundle(const std::filesystem::path& recording, const std::string& case_name,
                          const std::filesystem::path& data, const std::filesystem::path& zip,
                          const SessionRequest* labels = nullptr, const Progress& progress = no_progress);

/// True when the file is a zip archive with a bundle.json; looked at by ream-reader.
bool is_session_bundle(const std::filesystem::path& file);

/// Puts a bundle's session and case into the data folder and returns the session's id. ream-reader unpacks
/// and reads it; nothing but the files that a bundle has is taken. A case that is there with the same content
/// is kept. Who trained, and for which study, means nothing here or somebody else: that is left out unless
/// `keep_labels`. Errors: invalid_input for what is no whole bundle; conflict when the session is there
/// already, or another case of that name. Nothing is left behind on an error.
std::string import_session_bundle(const std::filesystem::path& zip, const std::filesystem::path& data,
                                  bool keep_labels);

}  // namespace ream::session
