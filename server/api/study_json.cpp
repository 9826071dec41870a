#include "api/study_json.hpp"

#include "api/request_body.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

constexpr size_t max_study_name = 200, longest_description = 4000, max_profile = 64, most_cases = 50;
constexpr int64_t most_procedures = 100'000;

json text_or_null(const std::string& text) { return text.empty() ? json(nullptr) : json(text); }

}  // namespace

json summary_json(const StudyView& told) {
  const study::Study& study = told.study;
  return {{"id", study.id},
          {"name", study.name},
          {"description", study.description},
          {"state", study.open ? "open" : "closed"},
          {"blinded", study.blinded()},
          {"created_utc", study.created_utc},
          {"closed_utc", text_or_null(study.closed_utc)},
          {"unblinded_utc", text_or_null(study.unblinded_utc)},
          {"cases", study.settings.cases},
          {"script", text_or_null(study.settings.script)},
          {"device", text_or_null(study.settings.device)},
          {"device_profile", text_or_null(study.settings.device_profile)},
          {"join_code", told.to_staff ? json(study.join_code) : json(nullptr)},
          {"participants", told.to_staff ? json(told.participants) : json(nullptr)},
          {"participant", text_or_null(told.own_code)}};
}

json to_json(const StudyView& told) {
  json all = summary_json(told);
  all["questionnaire"] = told.study.questionnaire ? to_json(*told.study.questionnaire) : json(nullptr);
  return all;
}

json to_json(const study::Participant& participant) {
  const bool known = !participant.experience.empty();
  return {{"code", participant.code},
          {"experience", text_or_null(participant.experience)},
          {"procedures_done", known ? json(participant.procedures_done) : json(nullptr)},
          {"answers", participant.answers.value_or(json(nullptr))},
          {"has_account", participant.has_account}};
}

json to_json(const store::PersonRow& person) {
  return {{"code", person.code}, {"user_id", text_or_null(person.user_id)}, {"name", person.name}};
}

study::StudyDraft study_draft_in(const net::Request& request) {
  RequestBody body(request);
  study::StudyDraft draft;
  draft.name = body.words("name", 1, max_study_name);
  draft.description = body.words("description", 0, longest_description);
  draft.settings.cases = body.names("cases", 1, most_cases);
  draft.settings.script = body.name_or("script", "");
  draft.settings.device = body.name_or("device", "");
  draft.settings.device_profile = body.words("device_profile", 0, max_profile);
  const std::optional<json> questionnaire = body.value_or_none("questionnaire");
  body.finish();
  if (!questionnaire)
    draft.questionnaire = study::face_validity_questionnaire();
  else if (!questionnaire->is_null())
    draft.questionnaire = study::questionnaire_from(*questionnaire);
  return draft;
}

study::NewParticipant new_participant_in(const net::Request& request, bool person) {
  RequestBody body(request);
  study::NewParticipant wanted;
  wanted.experience = body.one_of("experience", study::experience_levels);
  wanted.procedures_done = body.count("procedures_done", most_procedures);
  if (person) {
    wanted.user_id = body.name_or("user_id", "");
    wanted.name = body.words("name", 0, max_study_name);
  } else {
    wanted.join_code = body.name("join_code");
  }
  body.finish();
  if (!wanted.user_id.empty() && !wanted.name.empty())
    throw net::RequestError(422, "'name' is for somebody without an account; leave it out beside 'user_id'",
                            {{"#/name", "must not stand beside user_id"}});
  return wanted;
}

}  // namespace ream::api
