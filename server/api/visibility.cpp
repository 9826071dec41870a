#include "api/visibility.hpp"

#include "access/role.hpp"
#include "core/error.hpp"

namespace ream::api {

std::optional<session::SessionRequest> ServedSessions::session_of(const std::string& id) const {
  try {
    return sessions_.get(replays_.has(id) ? replays_.get(id).request.replay_of : id).request;
  } catch (const Error& unknown) {
    if (unknown.kind() != ErrorKind::not_found) throw;
    return std::nullopt;
  }
}

bool ServedSessions::is_rated_by(const net::Caller& caller, const std::string& id) const {
  if (replays_.has(id)) return false;
  const auto session = session_of(id);
  return session && ratings_.hides(caller, *session);
}

bool ServedSessions::hides_results(const net::Caller& caller, const std::string& id) const {
  const auto session = session_of(id);
  return session && feel_.hides(caller, *session);
}

bool may_see(const net::Caller& caller, const session::SessionRequest& session) {
  switch (access::role_bit(caller.role)) {
    case access::operators:
    case access::instructors: return true;
    case access::trainees: return !caller.user_id.empty() && caller.user_id == session.trainee_id;
    case access::viewers: return caller.only_session.empty() || caller.only_session == session.id;
    default: return false;
  }
}

std::string counted_for(const net::Caller& caller) {
  if (access::is_staff(caller.role)) return {};
  return caller.user_id.empty() ? caller.credential : caller.user_id;
}

void refuse_unseen(const std::string& id) { throw Error(ErrorKind::not_found, "no session '" + id + "'"); }

}  // namespace ream::api
