#include <nlohmann/json.hpp>

#include "api/case_work_resource.hpp"
#include "api/request_body.hpp"
#include "case/measures.hpp"
#include "case/plan.hpp"
#include "core/log.hpp"
#include "shell/parametric_profile.hpp"
#include "shell/reamer_library.hpp"
#include "workup/case_json.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

const std::string case_path = "/api/v1/cases/{id}";
const std::string place = "the request body";

net::Response measures(workup::CaseService& case_service, const net::Request& request) {
  const std::string& id = request.parameters.at("id");
  const case_::Side side = case_service.side_of(id);
  return net::json_response(200, case_::to_json(case_::measure(case_service.landmarks(id), side)));
}

net::Response landmarks(workup::CaseService& case_service, const net::Request& request) {
  return net::json_response(200, case_::to_json(case_service.landmarks(request.parameters.at("id"))));
}

net::Response plan(workup::CaseService& case_service, const net::Request& request) {
  const std::string& id = request.parameters.at("id");
  json plan = workup::case_json(case_service.folder_of(id)).at("plan");
  if (plan.is_null()) throw Error(ErrorKind::not_found, "case '" + id + "' has no plan yet; PUT one");
  return net::json_response(200, plan);
}

net::Response set_landmarks(workup::CaseService& case_service, const net::Request& request) {
  const std::string& id = request.parameters.at("id");
  case_service.set_landmarks(id, case_::landmarks_from_json(json_object_in(request), place));
  return net::json_response(200, workup::case_json(case_service.folder_of(id)));
}

/// Over the network a reamer has a name or words; a path would open the server's files.
void check_reamer(const std::string& reamer, const std::filesystem::path& data_folder) {
  if (reamer.empty() || shell::is_parametric(reamer)) return;
  try {
    shell::reamer_named(reamer, data_folder);
  } catch (const Error& unknown) {
    throw net::RequestError(422, unknown.what(), {{"#/reamer", "is no reamer of the library"}});
  }
}

net::Response propose(workup::CaseService& case_service, const std::filesystem::path& data_folder,
                      const net::Request& request) {
  const std::string& id = request.parameters.at("id");
  const auto targets = case_::plan_targets_from_json(json_object_in(request), place);
  check_reamer(targets.reamer, data_folder);
  const case_::Plan plan = case_service.propose(id, targets);
  return net::json_response(200, {{"plan", workup::plan_json(plan)},
                                  {"assessment", case_::to_json(case_service.assess(id, plan))}});
}

net::Response set_plan(workup::CaseService& case_service, const std::filesystem::path& data_folder,
                       const net::Request& request) {
  const std::string& id = request.parameters.at("id");
  const case_::Plan plan = case_::plan_from_json(json_object_in(request), place);
  check_reamer(plan.reamer, data_folder);
  const case_::PlanAssessment assessment = case_service.set_plan(id, plan);
  return net::json_response(200,
                            {{"plan", workup::plan_json(plan)}, {"assessment", case_::to_json(assessment)}});
}

json reamer_json(const shell::LibraryReamer& reamer) {
  json nipple;
  if (reamer.nipple)
    nipple = {{"radius_mm", reamer.nipple->radius_mm}, {"height_mm", reamer.nipple->height_mm}};
  return {{"name", reamer.name},
          {"words", reamer.words},
          {"diameter_mm", reamer.diameter_mm},
          {"radius_mm", reamer.radius_mm},
          {"nipple", std::move(nipple)},
          {"cannulated", reamer.cannulated},
          {"description", reamer.description}};
}

net::Response reamers_response(const std::filesystem::path& data_folder) {
  std::vector<std::string> warnings;
  json list = json::array();
  for (const shell::LibraryReamer& reamer : shell::reamers_of(data_folder, &warnings))
    list.push_back(reamer_json(reamer));
  for (const std::string& warning : warnings) log::warn(warning);
  return net::json_response(200, {{"reamers", std::move(list)}});
}

}  // namespace

void add_case_plan_routes(net::Router& router, workup::CaseService& case_service,
                          const std::filesystem::path& data_folder) {
  router.on("GET", case_path + "/measures",
            [&case_service](const net::Request& request) { return measures(case_service, request); });
  router.on("GET", case_path + "/landmarks",
            [&case_service](const net::Request& request) { return landmarks(case_service, request); });
  router.on("GET", case_path + "/plan",
            [&case_service](const net::Request& request) { return plan(case_service, request); });
  router.on("PUT", case_path + "/landmarks",
            [&case_service](const net::Request& request) { return set_landmarks(case_service, request); });
  router.on("POST", case_path + "/plan/proposal", [&case_service, data_folder](const net::Request& request) {
    return propose(case_service, data_folder, request);
  });
  router.on("PUT", case_path + "/plan", [&case_service, data_folder](const net::Request& request) {
    return set_plan(case_service, data_folder, request);
  });
  router.on("GET", "/api/v1/reamers",
            [data_folder](const net::Request&) { return reamers_response(data_folder); });
}

}  // namespace ream::api
