#pragma once
#include "api/replay_service.hpp"
#include "api/session_service.hpp"
#include "api/study_service.hpp"
#include "net/message.hpp"

namespace ream::api {

/// GET /api/v1/sessions: a page of the sessions that the caller may see, as they may know them, and the
/// replays of such that are open. `studies` null: there are none. Errors: invalid_input for a bad cursor;
/// unavailable while the index cannot be asked.
net::Response list_sessions(const SessionService& sessions, const StudyService* studies,
                            const ReplayService& replays, const net::Request& request);

}  // namespace ream::api
