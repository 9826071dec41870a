#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "session/running_session.hpp"

namespace ream::session {

/// Closes what a session left behind that did not come to its end: cuts the recording to its whole chunks
/// (more than a torn last one is kept beside it, as recording.ream.cut),
/// appends an event and the end, computes metrics from the recorded ticks, and writes metrics.json and
/// session.json with `state` and `cause` ("the server was killed"), to which is added what was kept. A
/// recording that says it was closed keeps the state it says. The caller holds the folder's lock. Returns the
/// words of session.json. Throws Error when something cannot be read or written; everything is then as it
/// was.
std::string close_session_folder(const std::filesystem::path& folder, const std::filesystem::path& data,
                                 SessionState state, const std::string& cause);

/// Closes every session of the data folder that is live on paper but in no process, as interrupted. Returns a
/// line for each, whether it could be closed or not.
std::vector<std::string> recover_sessions(const std::filesystem::path& data);

}  // namespace ream::session
