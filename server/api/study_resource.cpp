#include <nlohmann/json.hpp>

#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "core/text.hpp"
#include "net/problem.hpp"
#include "study/study_sessions.hpp"
#include "study/validity_input.hpp"
#include "study/validity_tables.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

const std::string studies_path = "/api/v1/studies";

const std::string& code_of(const net::Request& request) { return request.parameters.at("code"); }

/// What REST says of a study to its staff and to those who take part.
struct StudyView {
  const study::Study& study;
  bool to_staff = false;
  int64_t participants = 0;                ///< for staff only
  std::string own_code;                    ///< of the caller; empty: does not take part
  std::optional<study::NextSession> next;  ///< of the caller
  bool rates = false;                      ///< the caller rates its sessions
};

/// Without the questionnaire.
json summary_json(const StudyView& view) {
  const study::Study& study = view.study;
  return {{"id", study.id},
          {"name", study.name},
          {"description", study.description},
          {"state", study.open ? "open" : "closed"},
          {"blinded", study.blinded()},
          {"created_utc", study.created_utc},
          {"closed_utc", or_null(study.closed_utc)},
          {"unblinded_utc", or_null(study.unblinded_utc)},
          {"cases", study.settings.cases},
          {"script", or_null(study.settings.script)},
          {"device", or_null(study.settings.device)},
          {"device_profile", or_null(study.settings.device_profile)},
          {"design", study.settings.design ? to_json(*study.settings.design) : json(nullptr)},
          {"feel", study.settings.feel ? to_json(*study.settings.feel) : json(nullptr)},
          {"allocation_seed", study.open ? json(nullptr) : or_null(study.allocation_seed)},
          {"rates", view.rates},
          {"join_code", view.to_staff ? json(study.join_code) : json(nullptr)},
          {"participants", view.to_staff ? json(view.participants) : json(nullptr)},
          {"participant", or_null(view.own_code)}};
}

json next_json(const study::NextSession& next) {
  return {
      {"phase", to_text(next.phase)},
      {"number", next.number},
      {"of", next.of},
      {"not_before", next.not_before_day > 0 ? json(study::date_text(next.not_before_day)) : json(nullptr)}};
}

json study_json(const StudyView& view) {
  json all = summary_json(view);
  const auto form_json = [](const auto& form) { return form ? to_json(*form) : json(nullptr); };
  all["questionnaire"] = form_json(view.study.questionnaire);
  all["rating_form"] = form_json(view.study.settings.rating_form);
  all["next_session"] = view.next ? next_json(*view.next) : json(nullptr);
  return all;
}

json person_json(const store::PersonRow& person) {
  return {{"code", person.code}, {"user_id", or_null(person.user_id)}, {"name", person.name}};
}

/// Errors: those of the questionnaire; RequestError 422 for a case that comes twice.
study::StudyDraft study_draft_from(const json& body) {
  study::StudyDraft draft{
      body.at("name"),
      text_in(body, "description"),
      {different_texts_in(body, "cases"), text_in(body, "script"), text_in(body, "device"),
       text_in(body, "device_profile"), std::nullopt, std::nullopt},
      std::nullopt};
  if (body.contains("design") && !body["design"].is_null())
    draft.settings.design = study::design_from(body["design"]);
  if (body.contains("feel") && !body["feel"].is_null())
    draft.settings.feel = study::feel_trials_from(body["feel"]);
  if (!body.contains("rating_form")) {
    if (!draft.settings.feel) draft.settings.rating_form = study::default_rating_form();
  } else if (!body["rating_form"].is_null()) {
    draft.settings.rating_form = study::questionnaire_from(body["rating_form"]);
  }
  if (!body.contains("questionnaire"))
    draft.questionnaire = study::face_validity_questionnaire();
  else if (!body["questionnaire"].is_null())
    draft.questionnaire = study::questionnaire_from(body["questionnaire"]);
  return draft;
}

/// Of NewParticipant or Joining. RequestError 422 when a person is named by user_id and name.
study::NewParticipant new_participant_from(const json& body) {
  study::NewParticipant wanted{body.at("experience"), body.value("procedures_done", int64_t{0}),
                               text_in(body, "user_id"), text_in(body, "name"), text_in(body, "join_code")};
  if (!wanted.user_id.empty() && !wanted.name.empty())
    throw net::RequestError(422, "'name' is for somebody without an account; leave it out beside 'user_id'",
                            {{"#/name", "must not stand beside user_id"}});
  return wanted;
}

StudyView study_view(const Services& services, const net::Request& request, const study::Study& study) {
  return {study,
          access::is_staff(request.caller.role),
          services.studies.count(study.id),
          services.studies.code_of(request.caller, study.id),
          std::nullopt,
          services.ratings.rates(request.caller, study.id)};
}

net::Response study_reply(const Services& services, const net::Request& request, const study::Study& study) {
  StudyView view = study_view(services, request, study);
  if (!view.own_code.empty()) view.next = services.studies.next(study, view.own_code);
  return net::json_response(200, study_json(view));
}

net::Response list_studies(const Services& services, const net::Request& request) {
  json studies = json::array();
  for (const study::Study& study : services.studies.list(request.caller))
    studies.push_back(summary_json(study_view(services, request, study)));
  return net::json_response(200, {{"studies", std::move(studies)}});
}

net::Response create_study(const Services& services, const net::Request& request) {
  const study::Study study = services.studies.create(study_draft_from(body_of(request)));
  services.audit(request, "study.create", study.id, study.name);
  return created(studies_path + "/" + study.id, study_json(study_view(services, request, study)));
}

net::Response join_study(const Services& services, const net::Request& request) {
  const study::NewParticipant about = new_participant_from(body_of(request));
  const auto [id, participant] = services.studies.join(request.caller, about);
  services.audit(request, "study.join", id, "");
  json view = to_json(participant);
  view["study"] = id;
  return created(studies_path + "/" + id + "/participants/" + participant.code, view);
}

net::Response enrol_participant(const Services& services, const net::Request& request) {
  const study::Participant participant =
      services.studies.enrol(request.caller, id_of(request), new_participant_from(body_of(request)));
  services.audit(request, "study.enrol", id_of(request), participant.code);
  return created(studies_path + "/" + id_of(request) + "/participants/" + participant.code,
                 to_json(participant));
}

net::Response list_participants(const Services& services, const net::Request& request) {
  json list = json::array();
  for (const study::Participant& participant : services.studies.participants(request.caller, id_of(request)))
    list.push_back(to_json(participant));
  return net::json_response(200, {{"participants", std::move(list)}});
}

net::Response list_persons(const Services& services, const net::Request& request) {
  json list = json::array();
  for (const store::PersonRow& person : services.studies.persons(request.caller, id_of(request)))
    list.push_back(person_json(person));
  services.audit(request, "study.persons", id_of(request), "looked up who takes part");
  return net::json_response(200, {{"persons", std::move(list)}});
}

net::Response export_study(const Services& services, const net::Request& request) {
  const std::string format = query_text(request, "format", "json");
  const std::string table = query_text(request, "table", "sessions");
  const study::StudyExport all = services.studies.export_all(request.caller, id_of(request));
  services.audit(request, "study.export", id_of(request), format == "csv" ? table + " as CSV" : "JSON");
  if (format == "json")
    return net::json_response(200, {{"study", id_of(request)},
                                    {"sessions", session::json_of(all.sessions)},
                                    {"answers", session::json_of(all.answers)},
                                    {"groups", session::json_of(all.groups)},
                                    {"ratings", session::json_of(all.ratings)}});
  const session::ExportTable& chosen = table == "answers"   ? all.answers
                                       : table == "groups"  ? all.groups
                                       : table == "ratings" ? all.ratings
                                                            : all.sessions;
  return csv_response(chosen, id_of(request) + "-" + table + ".csv");
}

/// Tables have the names under which the script reads them.
net::Response get_validity(const Services& services, const net::Request& request) {
  const std::string form = query_text(request, "form", "report");
  if (form == "script") {
    net::Response response = net::bytes_response(200, "text/plain; charset=utf-8",
                                                 net::share(std::string(study::validity_script())));
    response.headers.emplace_back("Content-Disposition", "attachment; filename=\"validity.R\"");
    return response;
  }
  const study::ValidityInput input = services.studies.validity_input(request.caller, id_of(request));
  services.audit(request, "study.validity", id_of(request), form);
  if (form == "sessions") return csv_response(validity_sessions_table(input), "sessions.csv");
  if (form == "ratings") return csv_response(validity_ratings_table(input), "ratings.csv");
  study::ValidityReport report;
  services.executor.run([&] { report = validity_report(input); });
  if (form == "numbers") return csv_response(validity_numbers_table(report), "numbers.csv");
  return net::json_response(200, validity_json(report));
}

net::Response get_study(const Services& services, const net::Request& request) {
  return study_reply(services, request, services.studies.get(request.caller, id_of(request)));
}

net::Response study_changed(const Services& services, const net::Request& request, const study::Study& study,
                            const char* action) {
  services.audit(request, action, study.id, study.name);
  return study_reply(services, request, study);
}

/// What the body leaves out of cases, questionnaire, design, feel and form stays as it is.
net::Response change_study(const Services& services, const net::Request& request) {
  const json& body = body_of(request);
  study::StudyDraft draft = study_draft_from(body);
  const study::Study before = services.studies.get(request.caller, id_of(request));
  if (!body.contains("questionnaire")) draft.questionnaire = before.questionnaire;
  if (!body.contains("design")) draft.settings.design = before.settings.design;
  if (!body.contains("cases")) draft.settings.cases = before.settings.cases;
  if (!body.contains("feel")) draft.settings.feel = before.settings.feel;
  if (!body.contains("rating_form")) draft.settings.rating_form = before.settings.rating_form;
  const study::Study study = services.studies.change(id_of(request), draft);
  return study_changed(services, request, study, "study.change");
}

net::Response close_study(const Services& services, const net::Request& request) {
  return study_changed(services, request, services.studies.close(id_of(request)), "study.close");
}

net::Response reopen_study(const Services& services, const net::Request& request) {
  return study_changed(services, request, services.studies.reopen(id_of(request)), "study.reopen");
}

net::Response unblind_study(const Services& services, const net::Request& request) {
  return study_changed(services, request, services.studies.unblind(id_of(request)), "study.unblind");
}

net::Response remove_study(const Services& services, const net::Request& request) {
  services.studies.remove(id_of(request));
  return no_content();
}

net::Response get_participant(const Services& services, const net::Request& request) {
  return net::json_response(
      200, to_json(services.studies.participant(request.caller, id_of(request), code_of(request))));
}

net::Response withdraw_participant(const Services& services, const net::Request& request) {
  services.studies.withdraw(id_of(request), code_of(request));
  services.audit(request, "study.withdraw", id_of(request), code_of(request));
  return no_content();
}

net::Response answer_questions(const Services& services, const net::Request& request) {
  return net::json_response(200, to_json(services.studies.answer(request.caller, id_of(request),
                                                                 code_of(request), body_of(request))));
}

net::Response get_codebook(const Services& services, const net::Request& request) {
  return net::json_response(200, services.studies.codebook(id_of(request)));
}

}  // namespace

std::vector<Route> study_routes() {
  using namespace access;
  const std::string one = studies_path + "/{id}";
  const std::string participants = one + "/participants", participant = participants + "/{code}";
  const RouteChange changed{"study", "changed"};
  return {{"GET", studies_path, reamers, not_audited, list_studies},
          {"POST", studies_path, staff, audited_by_handler, create_study, {"study", "created"}},
          {"POST", studies_path + "/join", reamers, audited_by_handler, join_study},
          {"GET", one, reamers, not_audited, get_study},
          {"PUT", one, staff, changes("study.change"), change_study, changed},
          {"DELETE", one, operators, changes("study.delete"), remove_study, {"study", "deleted"}},
          {"POST", one + "/close", staff, audited_by_handler, close_study, changed},
          {"POST", one + "/reopen", staff, audited_by_handler, reopen_study, changed},
          {"POST", one + "/unblind", operators, audited_by_handler, unblind_study, changed},
          {"GET", participants, staff, reads("study.participants"), list_participants},
          {"POST", participants, staff, audited_by_handler, enrol_participant},
          {"GET", participant, reamers, reads("study.participants"), get_participant},
          {"DELETE", participant, operators, audited_by_handler, withdraw_participant, changed},
          {"PUT", participant + "/answers", reamers, changes("study.answers"), answer_questions, changed},
          {"GET", one + "/persons", staff, audited_by_handler, list_persons},
          {"GET", one + "/codebook", staff, not_audited, get_codebook},
          {"GET", one + "/validity", staff, audited_by_handler, get_validity},
          {"GET", one + "/export", staff, audited_by_handler, export_study}};
}

}  // namespace ream::api
