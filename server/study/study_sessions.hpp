#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "session/folder/session_folder.hpp"
#include "study/study_design.hpp"

namespace ream::study {

/// Days since 1970 of "2026-01-31T12:00:00Z"; 0 for what is no date.
int64_t day_of(const std::string& utc);
/// "2026-01-31".
std::string date_text(int64_t days_since_1970);

/// The participant went back to intact bone in a session of its own.
inline bool given_up(const session::SessionRecord& session) { return !session.request.followed_by.empty(); }

/// Whether the session ended as its participant wanted, on the bone with which it began.
inline bool carried_out(const session::SessionRecord& session) {
  const SessionState state = session.status.state;
  return (state == SessionState::finished || state == SessionState::stopped) && !given_up(session);
}

/// Whether the reamer touched bone, by what metrics.json says: who never did has not done what the session
/// was for.
bool touched_bone(const nlohmann::json& metrics);

/// Whether it touched bone in places farther apart than one plate of a study of feel is deep and wide: both
/// plates then, which lie 38.6 mm apart. By what metrics.json says.
bool touched_both_plates(const nlohmann::json& metrics);

/// Those of one participant, oldest first.
std::vector<const session::SessionRecord*> sessions_of(const std::string& code,
                                                       const std::vector<session::SessionRecord>& sessions);

}  // namespace ream::study
