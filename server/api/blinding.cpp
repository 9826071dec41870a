#include "api/blinding.hpp"

#include "api/rights.hpp"

namespace ream::api {

bool Blinding::hides(const SessionRequest& session) const {
  if (session.study.empty() || role_bit(caller_.role) == operators) return false;
  if (!caller_.user_id.empty() && caller_.user_id == session.trainee_id) return false;
  return !unblinded_.contains(session.study);
}

SessionRequest Blinding::seen(SessionRequest session) const {
  if (hides(session)) {
    session.trainee_id.clear();
    session.trainee = session.participant;
  }
  return session;
}

}  // namespace ream::api
