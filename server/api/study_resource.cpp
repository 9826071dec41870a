#include "api/study_resource.hpp"

#include <nlohmann/json.hpp>

#include "access/role.hpp"
#include "api/request_body.hpp"
#include "api/study_json.hpp"
#include "core/error.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

const std::string studies_path = "/api/v1/studies";

const std::string& code_of(const net::Request& request) { return request.parameters.at("code"); }

/// What all routes of studies need.
struct Desk {
  study::StudyService* service_or_none;
  Audit audit;

  study::StudyService& service() const {
    if (!service_or_none)
      throw Error(ErrorKind::unavailable, "this server has no database, so it has no studies");
    return *service_or_none;
  }

  StudyView told(const net::Request& request, const study::Study& study) const {
    return {study, (access::role_bit(request.caller.role) & access::staff) != 0, service().count(study.id),
            service().code_of(request.caller, study.id)};
  }
  net::Response reply(const net::Request& request, int status, const study::Study& study) const {
    return net::json_response(status, to_json(told(request, study)));
  }
  net::Response created(const std::string& where, const json& body) const {
    net::Response response = net::json_response(201, body);
    response.headers.emplace_back("Location", where);
    return response;
  }
};

net::Response list(const Desk& desk, const net::Request& request) {
  json studies = json::array();
  for (const study::Study& study : desk.service().list(request.caller))
    studies.push_back(summary_json(desk.told(request, study)));
  return net::json_response(200, {{"studies", std::move(studies)}});
}

net::Response create(const Desk& desk, const net::Request& request) {
  const study::Study study = desk.service().create(study_draft_in(request));
  desk.audit(request, "study.create", study.id, study.name);
  return desk.created(studies_path + "/" + study.id, to_json(desk.told(request, study)));
}

net::Response join(const Desk& desk, const net::Request& request) {
  const study::NewParticipant about = new_participant_in(request, false);
  const auto [id, participant] = desk.service().join(request.caller, about);
  desk.audit(request, "study.join", id, "");
  json told = to_json(participant);
  told["study"] = id;
  return desk.created(studies_path + "/" + id + "/participants/" + participant.code, told);
}

net::Response enrol(const Desk& desk, const net::Request& request) {
  const study::Participant participant =
      desk.service().enrol(request.caller, id_of(request), new_participant_in(request, true));
  desk.audit(request, "study.enrol", id_of(request), participant.code);
  return desk.created(studies_path + "/" + id_of(request) + "/participants/" + participant.code,
                      to_json(participant));
}

net::Response participants(const Desk& desk, const net::Request& request) {
  json list = json::array();
  for (const study::Participant& participant : desk.service().participants(request.caller, id_of(request)))
    list.push_back(to_json(participant));
  return net::json_response(200, {{"participants", std::move(list)}});
}

net::Response persons(const Desk& desk, const net::Request& request) {
  json list = json::array();
  for (const store::PersonRow& person : desk.service().persons(request.caller, id_of(request)))
    list.push_back(to_json(person));
  desk.audit(request, "study.persons", id_of(request), "looked up who takes part");
  return net::json_response(200, {{"persons", std::move(list)}});
}

std::string choice(const net::Request& request, const std::string& key, const std::string& usual,
                   const std::vector<std::string>& words) {
  const auto given = request.query.find(key);
  const std::string chosen = given == request.query.end() ? usual : given->second;
  if (std::find(words.begin(), words.end(), chosen) != words.end()) return chosen;
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : ", ") + word;
  throw Error(ErrorKind::invalid_input, key + " must be one of " + list + ", not '" + chosen + "'");
}

net::Response export_study(const Desk& desk, const net::Request& request) {
  const std::string format = choice(request, "format", "json", {"json", "csv"});
  const std::string table = choice(request, "table", "sessions", {"sessions", "answers", "groups"});
  const study::StudyExport all = desk.service().export_all(request.caller, id_of(request));
  desk.audit(request, "study.export", id_of(request), format == "csv" ? table + " as CSV" : "JSON");
  if (format == "json")
    return net::json_response(200, {{"study", id_of(request)},
                                    {"sessions", session::json_of(all.sessions)},
                                    {"answers", session::json_of(all.answers)},
                                    {"groups", session::json_of(all.groups)}});
  const session::ExportTable& chosen = table == "answers"  ? all.answers
                                       : table == "groups" ? all.groups
                                                           : all.sessions;
  net::Response response = net::bytes_response(200, "text/csv; charset=utf-8; header=present",
                                               net::share(session::csv_of(chosen)));
  response.headers.emplace_back("Content-Disposition",
                                "attachment; filename=\"" + id_of(request) + "-" + table + ".csv\"");
  return response;
}

void add_life_routes(net::Router& router, const Desk& desk) {
  const std::string one = studies_path + "/{id}";
  const auto on = [&](const std::string& word, study::Study (study::StudyService::*act)(const std::string&)) {
    router.on("POST", one + "/" + word, [desk, word, act](const net::Request& request) {
      const study::Study study = (desk.service().*act)(id_of(request));
      desk.audit(request, "study." + word, study.id, study.name);
      return desk.reply(request, 200, study);
    });
  };
  on("close", &study::StudyService::close);
  on("reopen", &study::StudyService::reopen);
  on("unblind", &study::StudyService::unblind);
  router.on("PUT", one, [desk](const net::Request& request) {
    const study::Study study = desk.service().change(id_of(request), study_draft_in(request));
    desk.audit(request, "study.change", study.id, study.name);
    return desk.reply(request, 200, study);
  });
  router.on("DELETE", one, [desk](const net::Request& request) {
    desk.service().remove(id_of(request));
    desk.audit(request, "study.delete", id_of(request), "");
    return net::Response{204, {}, nullptr, {}};
  });
}

void add_participant_routes(net::Router& router, const Desk& desk) {
  const std::string all = studies_path + "/{id}/participants", one = all + "/{code}";
  router.on("GET", all, [desk](const net::Request& request) { return participants(desk, request); });
  router.on("POST", all, [desk](const net::Request& request) { return enrol(desk, request); });
  router.on("GET", one, [desk](const net::Request& request) {
    return net::json_response(
        200, to_json(desk.service().participant(request.caller, id_of(request), code_of(request))));
  });
  router.on("DELETE", one, [desk](const net::Request& request) {
    desk.service().withdraw(id_of(request), code_of(request));
    desk.audit(request, "study.withdraw", id_of(request), code_of(request));
    return net::Response{204, {}, nullptr, {}};
  });
  router.on("PUT", one + "/answers", [desk](const net::Request& request) {
    return net::json_response(200, to_json(desk.service().answer(request.caller, id_of(request),
                                                                 code_of(request), json_object_in(request))));
  });
}

}  // namespace

void add_study_routes(net::Router& router, study::StudyService* service, const Audit& audit) {
  const Desk desk{service, audit};
  router.on("GET", studies_path, [desk](const net::Request& request) { return list(desk, request); });
  router.on("POST", studies_path, [desk](const net::Request& request) { return create(desk, request); });
  router.on("POST", studies_path + "/join",
            [desk](const net::Request& request) { return join(desk, request); });
  router.on("GET", studies_path + "/{id}", [desk](const net::Request& request) {
    return desk.reply(request, 200, desk.service().get(request.caller, id_of(request)));
  });
  add_life_routes(router, desk);
  add_participant_routes(router, desk);
  router.on("GET", studies_path + "/{id}/persons",
            [desk](const net::Request& request) { return persons(desk, request); });
  router.on("GET", studies_path + "/{id}/codebook", [desk](const net::Request& request) {
    return net::json_response(200, desk.service().codebook(id_of(request)));
  });
  router.on("GET", studies_path + "/{id}/export",
            [desk](const net::Request& request) { return export_study(desk, request); });
}

}  // namespace ream::api
