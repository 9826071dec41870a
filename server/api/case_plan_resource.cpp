#include <nlohmann/json.hpp>

#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "case/measures.hpp"
#include "case/plan.hpp"
#include "core/log.hpp"
#include "net/problem.hpp"
#include "score/plan_outcome.hpp"
#include "session/simulation/reamer.hpp"
#include "shell/parametric_profile.hpp"
#include "shell/reamer_library.hpp"
#include "workup/case_json.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

const std::string body_place = "the request body";

net::Response get_measures(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  const case_::Side side = services.cases.side_of(id);
  return net::json_response(200, case_::to_json(case_::measure(services.cases.landmarks(id), side)));
}

net::Response get_landmarks(const Services& services, const net::Request& request) {
  return net::json_response(200, case_::to_json(services.cases.landmarks(id_of(request))));
}

net::Response get_plan(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  json plan = workup::case_json(services.cases.folder_of(id)).at("plan");
  if (plan.is_null()) throw Error(ErrorKind::not_found, "case '" + id + "' has no plan yet; PUT one");
  return net::json_response(200, plan);
}

net::Response set_landmarks(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  services.cases.set_landmarks(id, case_::landmarks_from_json(body_of(request), body_place));
  return net::json_response(200, workup::case_json(services.cases.folder_of(id)));
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

net::Response propose_plan(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  const auto targets = case_::plan_targets_from_json(body_of(request), body_place);
  check_reamer(targets.reamer, services.data_folder);
  const case_::Plan plan = services.cases.propose(id, targets);
  return net::json_response(200, {{"plan", workup::plan_json(plan)},
                                  {"assessment", case_::to_json(services.cases.assess(id, plan))}});
}

net::Response assess_plan(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  const case_::Plan plan = case_::plan_from_json(body_of(request), body_place);
  check_reamer(plan.reamer, services.data_folder);
  const shell::ToolProfile reamer = session::tool_asked_for(plan.reamer, services.data_folder).profile;
  return net::json_response(200,
                            {{"assessment", case_::to_json(services.cases.assess(id, plan))},
                             {"outcome", score::outcome_json(services.cases.outcome(id, plan, reamer))}});
}

net::Response set_plan(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  const case_::Plan plan = case_::plan_from_json(body_of(request), body_place);
  check_reamer(plan.reamer, services.data_folder);
  const case_::PlanAssessment assessment = services.cases.set_plan(id, plan);
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

net::Response list_reamers(const Services& services, const net::Request&) {
  std::vector<std::string> warnings;
  json list = json::array();
  for (const shell::LibraryReamer& reamer : shell::reamers_of(services.data_folder, &warnings))
    list.push_back(reamer_json(reamer));
  for (const std::string& warning : warnings) log::warn(warning);
  return net::json_response(200, {{"reamers", std::move(list)}});
}

}  // namespace

std::vector<Route> case_plan_routes() {
  using access::reamers, access::staff;
  const std::string one = "/api/v1/cases/{id}";
  return {{"GET", one + "/measures", reamers, reads("case.read"), get_measures},
          {"GET", one + "/landmarks", reamers, reads("case.read"), get_landmarks},
          {"PUT", one + "/landmarks", staff, changes("case.landmarks"), set_landmarks, {"case", "changed"}},
          {"GET", one + "/plan", reamers, reads("case.read"), get_plan},
          {"POST", one + "/plan/proposal", staff, not_audited, propose_plan},
          {"POST", one + "/plan/assessment", staff, not_audited, assess_plan},
          {"PUT", one + "/plan", staff, changes("case.plan"), set_plan, {"case", "changed"}},
          {"GET", "/api/v1/reamers", reamers, not_audited, list_reamers}};
}

}  // namespace ream::api
