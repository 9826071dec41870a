#include "study/study_service.hpp"

#include <algorithm>
#include <map>

#include "access/role.hpp"
#include "access/secret.hpp"
#include "core/error.hpp"
#include "core/new_id.hpp"
#include "study/study_rows.hpp"

namespace ream::study {
using nlohmann::json;
namespace {

/// A code that is taken is drawn again; that it is taken so often means something else is wrong.
constexpr int max_draws = 20;

Error unknown_study(const std::string& id) { return {ErrorKind::not_found, "no study '" + id + "'"}; }

}  // namespace

StudyService::StudyService(store::Database& database, std::shared_ptr<const StudyDependencies> dependencies)
    : table_(database), ratings_(database), feel_answers_(database), dependencies_(std::move(dependencies)) {}

Study StudyService::known(const std::string& id) const {
  const auto row = table_.find(id);
  if (!row) throw unknown_study(id);
  return study_of(*row);
}

Study StudyService::open_one(const std::string& id) const {
  Study study = known(id);
  if (!study.open)
    throw Error(ErrorKind::conflict, "study '" + id + "' is closed; nothing more can be added to it");
  return study;
}

void StudyService::require_settings(const StudySettings& settings) const {
  if (settings.feel && (!settings.cases.empty() || settings.design || settings.rating_form))
    throw Error(ErrorKind::invalid_input,
                "a study of feel has plates of its own; leave out cases, design and rating_form");
  if (settings.feel && (settings.device.empty() || settings.device == "script"))
    throw Error(ErrorKind::invalid_input,
                "device: a study of feel needs one that a hand holds, such as browser or network");
  if (!settings.feel && settings.cases.empty())
    throw Error(ErrorKind::invalid_input, "cases: a study needs one or more");
  for (const std::string& case_id : settings.cases)
    if (!dependencies_->has_case(case_id)) throw Error(ErrorKind::not_found, "no case '" + case_id + "'");
  if (!settings.design || settings.design->test_case.empty()) return;
  if (std::find(settings.cases.begin(), settings.cases.end(), settings.design->test_case) ==
      settings.cases.end())
    throw Error(ErrorKind::invalid_input,
                "design.test_case '" + settings.design->test_case + "' is none of the study's cases");
}

void StudyService::require_no_rater(const net::Caller& caller, const std::string& id) const {
  if (ratings_.labels_of(caller.user_id).contains(id) && code_of(caller, id).empty())
    throw Error(ErrorKind::conflict, "you rate study '" + id + "'; somebody else runs its sessions");
}

Study StudyService::create(const StudyDraft& draft) {
  require_settings(draft.settings);
  Study study;
  study.name = draft.name;
  study.description = draft.description;
  study.settings = draft.settings;
  study.questionnaire = draft.questionnaire;
  study.id = random_id();
  study.join_code = random_id();
  study.allocation_seed = access::random_key();
  study.rating_key = access::random_key();
  study.created_utc = utc_now();
  table_.add(row_of(study));
  return study;
}

std::vector<Study> StudyService::list(const net::Caller& caller) const {
  const bool all = access::is_staff(caller.role);
  const auto own = all ? std::map<std::string, std::string>() : table_.codes_of(caller.user_id);
  std::vector<Study> studies;
  for (const store::StudyRow& row : table_.list())
    if (all || own.contains(row.id)) studies.push_back(study_of(row));
  return studies;
}

Study StudyService::get(const net::Caller& caller, const std::string& id) const {
  if (!access::is_staff(caller.role) && code_of(caller, id).empty()) throw unknown_study(id);
  return known(id);
}

Study StudyService::change(const std::string& id, const StudyDraft& draft) {
  Study study = known(id);
  const Study before = study;
  study.name = draft.name;
  study.description = draft.description;
  study.settings = draft.settings;
  study.questionnaire = draft.questionnaire;
  // Studies of earlier versions have none.
  for (std::string* key : {&study.allocation_seed, &study.rating_key})
    if (key->empty()) *key = access::random_key();
  const store::StudyRow was = row_of(before), is = row_of(study);
  if (was.settings != is.settings || was.questionnaire != is.questionnaire) {
    require_settings(draft.settings);
    if (!table_.participants(id).empty() || !ratings_.ratings(id).empty())
      throw Error(ErrorKind::conflict, "somebody takes part in study '" + id +
                                           "'; only its name and description can be changed now");
  }
  table_.replace(is);
  return study;
}

Study StudyService::close(const std::string& id) {
  Study study = open_one(id);
  study.open = false;
  study.closed_utc = utc_now();
  table_.replace(row_of(study));
  return study;
}

bool StudyService::is_closed(const std::string& id) const {
  const auto row = table_.find(id);
  return row && !study_of(*row).open;
}

Study StudyService::reopen(const std::string& id) {
  Study study = known(id);
  if (study.open) throw Error(ErrorKind::conflict, "study '" + id + "' is open");
  if (!study.blinded())
    throw Error(ErrorKind::conflict,
                "study '" + id + "' is unblinded; what is added to it now would not be blind");
  if (study.settings.design || study.settings.feel || !ratings_.raters(id).empty())
    throw Error(
        ErrorKind::conflict,
        "study '" + id +
            "' has arms, raters or trials of feel, and somebody could have seen since what is hidden");
  study.open = true;
  study.closed_utc.clear();
  table_.replace(row_of(study));
  return study;
}

Study StudyService::unblind(const std::string& id) {
  Study study = known(id);
  if (study.open)
    throw Error(ErrorKind::conflict, "study '" + id + "' is open; close it before its persons are shown");
  if (!study.blinded()) throw Error(ErrorKind::conflict, "study '" + id + "' is unblinded already");
  study.unblinded_utc = utc_now();
  table_.replace(row_of(study));
  return study;
}

void StudyService::remove(const std::string& id) {
  known(id);
  if (!table_.participants(id).empty())
    throw Error(ErrorKind::conflict, "somebody takes part in study '" + id + "'; it is kept");
  table_.remove(id);
}

Participant StudyService::add_participant(const Study& study, const NewParticipant& wanted,
                                          const std::optional<store::PersonRow>& person) {
  Participant participant{
      "", wanted.experience, wanted.procedures_done, std::nullopt, person && !person->user_id.empty(), ""};
  std::function<std::string(int64_t)> arm_of_place;
  if (const auto& design = study.settings.design)
    arm_of_place = [&](int64_t place) {
      return arm_at(*design, study.allocation_seed, wanted.experience, place).id;
    };
  for (int draw = 1;; ++draw) {
    participant.code = random_participant_code();
    std::optional<store::PersonRow> linked = person;
    if (linked) linked->code = participant.code;
    try {
      participant.arm = table_.enrol(row_of(study.id, participant), linked, wanted.experience, arm_of_place);
      return participant;
    } catch (const Error& failure) {
      if (failure.kind() != ErrorKind::conflict || draw == max_draws) throw;
      if (person && !table_.code_of(study.id, person->user_id).empty())
        throw Error(ErrorKind::conflict, (person->name.empty() ? "this person" : person->name) +
                                             " takes part in the study already");
    }
  }
}

Participant StudyService::enrol(const net::Caller& caller, const std::string& id,
                                const NewParticipant& wanted) {
  const Study study = open_one(id);
  require_no_rater(caller, id);
  const auto seen = [&](Participant participant) {
    if (!access::is_operator(caller.role)) participant.arm.clear();
    return participant;
  };
  if (wanted.user_id.empty() && wanted.name.empty())
    return seen(add_participant(study, wanted, std::nullopt));
  if (!access::is_operator(caller.role))
    throw net::RequestError(403,
                            "only operators may say who a participant is; give the person the join code");
  store::PersonRow person{"", wanted.user_id, wanted.name};
  if (!wanted.user_id.empty()) {
    const auto user = dependencies_->find_user(wanted.user_id);
    if (!user) throw Error(ErrorKind::not_found, "no user '" + wanted.user_id + "'");
    person.name = user->name;
  }
  return add_participant(study, wanted, person);
}

std::pair<std::string, Participant> StudyService::join(const net::Caller& caller,
                                                       const NewParticipant& about) {
  if (caller.user_id.empty())
    throw Error(ErrorKind::conflict,
                "only somebody with an account can join a study; others are enrolled by code");
  const auto row = table_.find_by_join_code(about.join_code);
  if (!row) throw Error(ErrorKind::not_found, "no study has this join code");
  const Study study = open_one(row->id);
  const store::PersonRow person{"", caller.user_id, caller.name};
  Participant participant = add_participant(study, about, person);
  participant.arm.clear();
  return {study.id, std::move(participant)};
}

}  // namespace ream::study
