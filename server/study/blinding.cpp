#include "study/blinding.hpp"

#include "access/role.hpp"
#include "study/feel_trials.hpp"

namespace ream::study {

bool Blinding::is_own(const session::SessionRequest& session) const {
  return !caller_.user_id.empty() && caller_.user_id == session.trainee_id;
}

bool Blinding::hides(const session::SessionRequest& session) const {
  if (hides_all(session)) return true;
  if (session.study.empty() || access::is_operator(caller_.role) || is_own(session)) return false;
  return !unblinded_.contains(session.study);
}

bool Blinding::hides_all(const session::SessionRequest& session) const {
  if (session.study.empty() || is_own(session)) return false;
  if (nothing_known_) return !access::is_operator(caller_.role);
  return rated_.contains(session.study);
}

session::SessionRecord Blinding::seen(session::SessionRecord record) const {
  session::SessionRequest& request = record.request;
  if (hides_all(request)) {
    request.participant.clear();
    request.phase.clear();
    request.title.clear();
    record.mark.reset();
  }
  if (request.phase == feel_phase) {
    record.mark.reset();
    if (!access::is_operator(caller_.role)) request.case_id = case_::two_plates_word;
  }
  if (hides(request)) {
    request.trainee_id.clear();
    request.trainee = request.participant;
  }
  return record;
}

}  // namespace ream::study
