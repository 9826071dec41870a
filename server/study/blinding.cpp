#include "study/blinding.hpp"

#include "access/role.hpp"

namespace ream::study {

bool Blinding::hides(const session::SessionRequest& session) const {
  if (session.study.empty() || access::role_bit(caller_.role) == access::operators) return false;
  if (!caller_.user_id.empty() && caller_.user_id == session.trainee_id) return false;
  return !unblinded_.contains(session.study);
}

session::SessionRequest Blinding::seen(session::SessionRequest session) const {
  if (hides(session)) {
    session.trainee_id.clear();
    session.trainee = session.participant;
  }
  return session;
}

}  // namespace ream::study
