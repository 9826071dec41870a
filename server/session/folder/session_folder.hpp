#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "core/file_lock.hpp"
#include "session/running_session.hpp"
#include "store/session_query.hpp"

namespace ream::session {

/// What a session is worth, in short.
struct SessionMark {
  std::optional<double> points;  ///< of 100; none where the session says nothing of what the rubric asks
  std::string outcome;           ///< pass, fail or undecided; empty where the rubric decides nothing
  std::string rubric;            ///< its name
  int version = 1;
};

/// A session as others see it.
struct SessionRecord {
  SessionRequest request;
  SessionStatus status;
  bool streamable = true;                ///< held in memory: its stream can be opened
  std::optional<SessionMark> mark = {};  ///< by its score.json, once it has ended
  /// Of one that was read from its folder: stays true until session.json is replaced. Else the session was
  /// left in a live state: that is its state while somebody holds its lock, and interrupted from then on.
  bool lasting = true;
};

/// Names of what lies in a session's folder.
std::filesystem::path session_json(const std::filesystem::path& folder);
std::filesystem::path metrics_json(const std::filesystem::path& folder);
std::filesystem::path score_json(const std::filesystem::path& folder);
std::filesystem::path recording_file(const std::filesystem::path& folder);
/// Held (core/file_lock.hpp) by the process in which the session lives, or that changes its files.
std::filesystem::path lock_file(const std::filesystem::path& folder);

/// What session.json, timing.json and score.json say, under the folder's name as id. Errors: not_found,
/// invalid_input, io; a score.json that cannot be read counts as none.
SessionRecord read_session_folder(const std::filesystem::path& folder);

/// What lists filter and sort a session by.
store::SessionRow row_of(const SessionRecord& record);
/// The whole row of the index. `stamp`: session_stamp() from before. Errors: as read_session_folder.
store::SessionRow read_session_row(const std::filesystem::path& folder, int64_t stamp);
/// What read_session_folder said when that row was read of this folder. Error invalid_input.
SessionRecord record_of(const store::SessionRow& row, const std::filesystem::path& folder);

/// Differs after session.json or score.json has been replaced. Zero without a session.json.
int64_t session_stamp(const std::filesystem::path& folder);

}  // namespace ream::session
