#include "study/feel_service.hpp"

#include "access/role.hpp"
#include "core/error.hpp"
#include "core/new_id.hpp"
#include "study/study_sessions.hpp"

namespace ream::study {

Study FeelService::study_of_feel(const net::Caller& caller, const std::string& id) const {
  Study study = studies_.get(caller, id);
  if (!study.settings.feel) throw Error(ErrorKind::conflict, "study '" + id + "' is no study of feel");
  return study;
}

std::string FeelService::session_of(const Study& study, const FeelTrial& trial, const std::string& code,
                                    const std::vector<store::FeelAnswerRow>& own) const {
  const std::vector<session::SessionRecord> all = dependencies_->sessions(study.id);
  std::string found;
  for (const session::SessionRecord* session : sessions_of(code, all)) {
    const session::SessionRequest& request = session->request;
    // Those before the last answer were for earlier trials, which may have had the same plates.
    const bool for_this = own.empty() || request.created_utc > own.back().answered_utc;
    if (for_this && request.case_id == trial.case_id() && carried_out(*session) &&
        touched_both_plates(dependencies_->metrics(request.id)))
      found = request.id;
  }
  return found;
}

FeelPlace FeelService::place(const net::Caller& caller, const std::string& id,
                             const std::string& code) const {
  const Study study = study_of_feel(caller, id);
  studies_.participant(caller, id, code);
  FeelPlace place;
  place.trial = studies_.next_feel_trial(study, code);
  if (place.trial)
    place.session = session_of(study, *place.trial, code, store::answers_of(table_.answers(id), code));
  return place;
}

FeelPlace FeelService::answer(const net::Caller& caller, const std::string& id, const std::string& code,
                              int number, const std::string& chosen) {
  const Study study = study_of_feel(caller, id);
  if (studies_.participant(caller, id, code).has_account && studies_.code_of(caller, id) != code)
    throw net::RequestError(403, "participant '" + code + "' has an account and answers there");
  if (!study.open)
    throw Error(ErrorKind::conflict, "study '" + id + "' is closed; nothing more can be added to it");
  const FeelPlace before = place(caller, id, code);
  if (!before.trial || before.trial->number != number)
    throw Error(ErrorKind::conflict,
                "trial " + std::to_string(number) + " is not the next one of participant '" + code + "'");
  if (dependencies_->has_live_session(id, code))
    throw Error(ErrorKind::conflict, "end the session first, then answer");
  if (before.session.empty())
    throw Error(ErrorKind::conflict, "feel both plates in a session first, then answer");
  table_.add(id, {code, number, chosen, before.session, utc_now_in_order()});
  return place(caller, id, code);
}

bool FeelService::hides(const net::Caller& caller, const session::SessionRequest& session) const {
  return session.phase == feel_phase && !access::is_operator(caller.role) &&
         !studies_.is_closed(session.study);
}

FeelReport FeelService::report(const net::Caller& caller, const std::string& id) const {
  const Study study = study_of_feel(caller, id);
  return feel_report(study, studies_.everybody_for_export(caller, id), table_.answers(id));
}

session::ExportTable FeelService::answers(const net::Caller& caller, const std::string& id) const {
  const Study study = study_of_feel(caller, id);
  return feel_answer_table(study, studies_.everybody_for_export(caller, id), table_.answers(id));
}

}  // namespace ream::study
