#include <algorithm>
#include <set>

#include "access/role.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "core/new_id.hpp"
#include "study/study_rows.hpp"
#include "study/study_service.hpp"
#include "study/study_sessions.hpp"
#include "study/validity_input.hpp"

namespace ream::study {
using nlohmann::json;
namespace {

Error unknown_participant(const std::string& id, const std::string& code) {
  return {ErrorKind::not_found, "no participant '" + code + "' in study '" + id + "'"};
}

/// Without all that tells participants apart.
Participant only_code(const Participant& participant) {
  return {participant.code, "", 0, std::nullopt, participant.has_account, ""};
}

void place_on_case(const Study& study, session::SessionRequest& wanted) {
  const auto& cases = study.settings.cases;
  if (wanted.case_id.empty()) wanted.case_id = cases.front();
  if (std::find(cases.begin(), cases.end(), wanted.case_id) == cases.end())
    throw Error(ErrorKind::conflict, "case '" + wanted.case_id + "' is none of study '" + study.id + "'");
}

}  // namespace

std::vector<Participant> StudyService::participants(const net::Caller& caller, const std::string& id) const {
  const bool hidden = known(id).open && !access::is_operator(caller.role);
  const std::string own = code_of(caller, id);
  std::set<std::string> with_account;
  for (const store::PersonRow& person : table_.persons(id))
    if (!person.user_id.empty()) with_account.insert(person.code);
  std::vector<Participant> list;
  for (const store::ParticipantRow& row : table_.participants(id)) {
    Participant participant = participant_of(row);
    participant.has_account = with_account.contains(participant.code);
    if (hidden) participant.arm.clear();
    list.push_back(hidden && participant.code != own ? only_code(participant) : participant);
  }
  return list;
}

std::set<std::string> StudyService::codes(const std::string& id) const {
  std::set<std::string> found;
  for (const store::ParticipantRow& row : table_.participants(id)) found.insert(row.code);
  return found;
}

std::string StudyService::code_of(const net::Caller& caller, const std::string& id) const {
  return table_.code_of(id, caller.user_id);
}

Participant StudyService::participant(const net::Caller& caller, const std::string& id,
                                      const std::string& code) const {
  const auto row = table_.participant(id, code);
  const bool own = code_of(caller, id) == code;
  if (!row || (!access::is_staff(caller.role) && !own)) throw unknown_participant(id, code);
  Participant found = participant_of(*row);
  const auto person = table_.person(id, code);
  found.has_account = person && !person->user_id.empty();
  if (access::is_operator(caller.role) || !known(id).open) return found;
  found.arm.clear();
  return own ? found : only_code(found);
}

std::vector<store::PersonRow> StudyService::persons(const net::Caller& caller, const std::string& id) const {
  if (known(id).blinded() && !access::is_operator(caller.role))
    throw net::RequestError(403, "who takes part in study '" + id + "' is hidden until it is unblinded");
  return table_.persons(id);
}

std::vector<Participant> StudyService::everybody_for_export(const net::Caller& caller,
                                                            const std::string& id) const {
  require_export(caller, known(id));
  return everybody(id);
}

Participant StudyService::answer(const net::Caller& caller, const std::string& id, const std::string& code,
                                 const json& answers) {
  Participant about = participant(caller, id, code);
  if (about.has_account && code_of(caller, id) != code)
    throw net::RequestError(403, "participant '" + code + "' has an account and answers there");
  const Study study = open_one(id);
  if (!study.questionnaire) throw Error(ErrorKind::conflict, "study '" + id + "' asks nothing");
  if (const auto faults = faults_of_answers(*study.questionnaire, answers); !faults.empty())
    throw net::RequestError(422, "the answers cannot be used: " + faults.front().detail, faults);
  table_.set_answers(id, code, answers.dump());
  about.answers = answers;
  return about;
}

void StudyService::withdraw(const std::string& id, const std::string& code) {
  known(id);
  table_.remove_participant(id, code);
}

std::vector<Participant> StudyService::everybody(const std::string& id) const {
  std::vector<Participant> all;
  for (const store::ParticipantRow& row : table_.participants(id)) all.push_back(participant_of(row));
  return all;
}

std::vector<SessionRating> StudyService::ratings_of(const std::string& id) const {
  std::vector<SessionRating> ratings;
  for (const store::RatingRow& row : ratings_.ratings(id))
    ratings.push_back({row.rater, row.session, parse_json(row.answers)});
  return ratings;
}

StudyExport StudyService::everything(const Study& study) const {
  return export_of(
      study, everybody(study.id), dependencies_->sessions(study.id),
      [this](const std::string& id) { return dependencies_->metrics(id); }, ratings_of(study.id));
}

void StudyService::require_export(const net::Caller& caller, const Study& study) const {
  if (study.open && !access::is_operator(caller.role))
    throw Error(ErrorKind::conflict, "study '" + study.id +
                                         "' is open; close it first, for whoever scores must not know how "
                                         "experienced participants are");
}

StudyExport StudyService::export_all(const net::Caller& caller, const std::string& id) const {
  const Study study = known(id);
  require_export(caller, study);
  return everything(study);
}

ValidityInput StudyService::validity_input(const net::Caller& caller, const std::string& id) const {
  const Study study = known(id);
  require_export(caller, study);
  if (study.settings.feel)
    throw Error(ErrorKind::conflict, "study '" + id + "' is one of feel and measures no skill; GET its feel");
  return validity_input_of(
      study, everybody(id), dependencies_->sessions(id),
      [this](const std::string& session) { return dependencies_->metrics(session); }, ratings_of(id));
}

json StudyService::codebook(const std::string& id) const {
  const Study study = known(id);
  return codebook_of(study, everything(study));
}

void StudyService::admit(const net::Caller& caller, session::SessionRequest& wanted) const {
  const std::string& id = wanted.study;
  get(caller, id);
  const Study study = open_one(id);
  if (!access::is_staff(caller.role) || wanted.participant.empty()) {
    const std::string own = code_of(caller, id);
    if (!wanted.participant.empty() && wanted.participant != own)
      throw unknown_participant(id, wanted.participant);
    if (own.empty())
      throw Error(ErrorKind::conflict,
                  "you do not take part in study '" + id + "'; say which participant trains");
    wanted.participant = own;
  }
  participant(caller, id, wanted.participant);
  require_no_rater(caller, id);
  wanted.script = study.settings.script;
  wanted.device_profile = study.settings.device_profile;
  if (study.settings.design) place_in_design(study, wanted);
  if (study.settings.feel)
    place_in_feel(study, wanted);
  else
    place_on_case(study, wanted);
  wanted.device = study.settings.device;
  const auto person = table_.person(id, wanted.participant);
  wanted.trainee_id = person ? person->user_id : "";
  wanted.trainee = person ? person->name : "";
}

std::optional<NextSession> StudyService::next(const Study& study, const std::string& code) const {
  const auto& design = study.settings.design;
  const auto row = table_.participant(study.id, code);
  const StudyArm* arm = design && row ? find_arm(*design, row->arm) : nullptr;
  if (arm == nullptr) return std::nullopt;
  std::vector<DoneSession> done;
  const std::vector<session::SessionRecord> all = dependencies_->sessions(study.id);
  for (const session::SessionRecord* session : sessions_of(code, all))
    if (carried_out(*session) && touched_bone(dependencies_->metrics(session->request.id)))
      done.push_back({phase_from(session->request.phase), day_of(session->request.created_utc)});
  return next_session(*design, *arm, done);
}

void StudyService::place_in_design(const Study& study, session::SessionRequest& wanted) const {
  const StudyDesign& design = *study.settings.design;
  const std::string& code = wanted.participant;
  require_no_live_session(study, code);
  const auto next = this->next(study, code);
  if (!next)
    throw Error(ErrorKind::conflict,
                "participant '" + code + "' has done every session of study '" + study.id + "'");
  if (next->not_before_day > day_of(utc_now()))
    throw Error(ErrorKind::conflict, "the " + std::string(to_text(next->phase)) + " test of participant '" +
                                         code + "' may be done from " + date_text(next->not_before_day) +
                                         " on");
  wanted.phase = to_text(next->phase);
  if (is_test(next->phase)) {
    const std::string& test_case = design.test_case.empty() ? study.settings.cases.front() : design.test_case;
    if (!wanted.case_id.empty() && wanted.case_id != test_case)
      throw Error(ErrorKind::conflict,
                  "participant '" + code + "' is tested next, on case '" + test_case + "'");
    wanted.case_id = test_case;
    wanted.theatre = design.test_theatre;
    return;
  }
  const StudyArm& arm = *find_arm(design, table_.participant(study.id, code)->arm);
  wanted.theatre = arm.theatre;
  if (!arm.script.empty()) wanted.script = arm.script;
  if (!arm.device_profile.empty()) wanted.device_profile = arm.device_profile;
}

std::optional<FeelTrial> StudyService::next_feel_trial(const Study& study, const std::string& code) const {
  if (!study.settings.feel) return std::nullopt;
  const size_t answered = store::answers_of(feel_answers_.answers(study.id), code).size();
  const std::vector<FeelTrial> trials = trials_for(*study.settings.feel, study.allocation_seed, code);
  return answered < trials.size() ? std::optional(trials[answered]) : std::nullopt;
}

void StudyService::place_in_feel(const Study& study, session::SessionRequest& wanted) const {
  require_no_live_session(study, wanted.participant);
  const auto trial = next_feel_trial(study, wanted.participant);
  if (!trial)
    throw Error(ErrorKind::conflict, "participant '" + wanted.participant +
                                         "' has answered every trial of study '" + study.id + "'");
  if (!wanted.case_id.empty())
    throw Error(ErrorKind::conflict, "the plates of a study of feel are chosen by the server; name no case");
  wanted.case_id = trial->case_id();
  wanted.phase = feel_phase;
  wanted.theatre = true;
}

void StudyService::require_no_live_session(const Study& study, const std::string& code) const {
  if (dependencies_->has_live_session(study.id, code))
    throw Error(ErrorKind::conflict,
                "participant '" + code + "' has a session that has not ended; stop it first");
}

std::vector<std::string> StudyService::rated_by(const net::Caller& caller) const {
  std::vector<std::string> open;
  for (const auto& [study, label] : ratings_.labels_of(caller.user_id))
    if (const auto row = table_.find(study); row && row->state == "open") open.push_back(study);
  return open;
}

void StudyService::require_repeatable(const session::SessionRequest& session) const {
  const auto phase = phase_from(session.phase);
  const std::string name = "session '" + session.id + "'";
  if (session.phase == feel_phase)
    throw Error(ErrorKind::conflict, name + " is of a study of feel; begin the next one from the study");
  if (session.study.empty() || !phase) return;
  if (is_test(*phase)) throw Error(ErrorKind::conflict, name + " is a test of its study, which is done once");
  const auto row = table_.find(session.study);
  if (!row || row->state != "open") throw Error(ErrorKind::conflict, "the study of " + name + " is closed");
  const auto next = this->next(study_of(*row), session.participant);
  if (!next || next->phase != Phase::training)
    throw Error(ErrorKind::conflict, "participant '" + session.participant + "' has done all training");
}

Blinding StudyService::blinding(const net::Caller& caller) const {
  std::set<std::string> unblinded, rated;
  try {
    for (const std::string& study : rated_by(caller)) rated.insert(study);
    if (access::is_operator(caller.role) && rated.empty()) return {caller, {}, {}};
    for (const store::StudyRow& row : table_.list())
      if (!row.unblinded_utc.empty()) unblinded.insert(row.id);
  } catch (const Error&) {
    return Blinding::of_nothing_known(caller);
  }
  return {caller, std::move(unblinded), std::move(rated)};
}

}  // namespace ream::study
