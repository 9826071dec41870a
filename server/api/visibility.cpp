#include "api/visibility.hpp"

#include "api/rights.hpp"
#include "core/error.hpp"

namespace ream::api {

bool may_see(const net::Caller& caller, const SessionRequest& session) {
  switch (role_bit(caller.role)) {
    case operators:
    case instructors:
      return true;
    case trainees:
      return !caller.user_id.empty() && caller.user_id == session.trainee_id;
    case viewers:
      return caller.only_session.empty() || caller.only_session == session.id;
    default:
      return false;
  }
}

void refuse_unseen(const std::string& id) {
  throw Error(ErrorKind::not_found, "no session '" + id + "'; GET /api/v1/sessions lists them");
}

void require_may_see(const net::Caller& caller, const SessionRequest& session) {
  if (!may_see(caller, session)) refuse_unseen(session.id);
}

}  // namespace ream::api
