#include "api/rights.hpp"

#include <algorithm>

namespace ream::api {
namespace {

using access::all_roles;
using access::instructors;
using access::operators;
using access::reamers;
using access::Roles;
using access::staff;
using access::trainees;
using access::viewers;

std::vector<Right> open_rows() {
  std::vector<Right> rows;
  for (const char* pattern : {"/healthz", "/readyz", "/api/v1/openapi.yaml", "/api/v1/login"})
    rows.push_back({"GET", pattern, RouteAccess::anybody});
  rows.push_back({"POST", "/api/v1/login", RouteAccess::anybody});
  rows.push_back({"DELETE", "/api/v1/login", RouteAccess::anybody});
  rows.push_back({"POST", "/api/v1/login/link", RouteAccess::anybody});
  rows.push_back({"GET", "/metrics", RouteAccess::monitoring, operators});
  return rows;
}

std::vector<Right> access_rows() {
  const std::string users = "/api/v1/users", user = users + "/{id}";
  const std::string tokens = "/api/v1/tokens", links = "/api/v1/links";
  return {{"POST", "/api/v1/login/password", RouteAccess::roles, reamers},
          {"GET", users, RouteAccess::roles, staff},
          {"POST", users, RouteAccess::roles, operators},
          {"GET", user, RouteAccess::roles, staff},
          {"PATCH", user, RouteAccess::roles, operators},
          {"DELETE", user, RouteAccess::roles, operators},
          {"GET", tokens, RouteAccess::roles, reamers},
          {"POST", tokens, RouteAccess::roles, reamers},
          {"DELETE", tokens + "/{id}", RouteAccess::roles, reamers},
          {"GET", links, RouteAccess::roles, staff},
          {"POST", links, RouteAccess::roles, staff},
          {"DELETE", links + "/{id}", RouteAccess::roles, staff},
          {"GET", "/api/v1/audit", RouteAccess::roles, operators}};
}

std::vector<Right> case_rows() {
  const std::string uploads = "/api/v1/uploads", upload = uploads + "/{id}";
  const std::string jobs = "/api/v1/jobs", cases = "/api/v1/cases", one = cases + "/{id}";
  return {{"GET", uploads, RouteAccess::roles, staff},
          {"POST", uploads, RouteAccess::roles, staff},
          {"GET", upload, RouteAccess::roles, staff},
          {"PUT", upload, RouteAccess::roles, staff},
          {"DELETE", upload, RouteAccess::roles, staff},
          {"GET", jobs, RouteAccess::roles, reamers},
          {"GET", jobs + "/{id}", RouteAccess::roles, reamers},
          {"GET", jobs + "/{id}/result", RouteAccess::roles, reamers},
          {"DELETE", jobs + "/{id}", RouteAccess::roles, reamers},
          {"GET", cases, RouteAccess::roles, reamers},
          {"POST", cases, RouteAccess::roles, staff},
          {"GET", one, RouteAccess::roles, reamers},
          {"DELETE", one, RouteAccess::roles, staff},
          {"GET", one + "/volume", RouteAccess::roles, reamers},
          {"GET", one + "/landmarks", RouteAccess::roles, reamers},
          {"GET", one + "/plan", RouteAccess::roles, reamers},
          {"GET", one + "/volume/slices/{axis}/{index}", RouteAccess::roles, reamers},
          {"GET", one + "/mesh", RouteAccess::roles, reamers},
          {"POST", one + "/segmentation", RouteAccess::roles, staff},
          {"POST", one + "/segmentation/undo", RouteAccess::roles, staff},
          {"POST", one + "/build", RouteAccess::roles, staff},
          {"PUT", one + "/landmarks", RouteAccess::roles, staff},
          {"GET", one + "/measures", RouteAccess::roles, reamers},
          {"PUT", one + "/plan", RouteAccess::roles, staff},
          {"POST", one + "/plan/proposal", RouteAccess::roles, staff},
          {"GET", "/api/v1/reamers", RouteAccess::roles, reamers}};
}

std::vector<Right> session_rows() {
  const std::string sessions = "/api/v1/sessions", one = sessions + "/{id}";
  return {{"GET", sessions, RouteAccess::roles, all_roles},
          {"POST", sessions, RouteAccess::roles, reamers},
          {"GET", one, RouteAccess::roles, all_roles},
          {"PATCH", one, RouteAccess::roles, reamers},
          {"DELETE", one, RouteAccess::roles, reamers},
          {"POST", one + "/restore", RouteAccess::roles, staff},
          {"GET", "/api/v1/trash", RouteAccess::roles, staff},
          {"POST", one + "/start", RouteAccess::roles, reamers},
          {"POST", one + "/pause", RouteAccess::roles, reamers},
          {"POST", one + "/reset", RouteAccess::roles, reamers},
          {"POST", one + "/stop", RouteAccess::roles, reamers},
          {"POST", one + "/resume", RouteAccess::roles, reamers},
          {"GET", one + "/annotations", RouteAccess::roles, all_roles},
          {"POST", one + "/annotations", RouteAccess::roles, reamers},
          {"POST", one + "/replay", RouteAccess::roles, all_roles},
          {"POST", one + "/playback", RouteAccess::roles, all_roles},
          {"GET", one + "/metrics", RouteAccess::roles, all_roles},
          {"GET", one + "/stream", RouteAccess::roles, all_roles},
          {"GET", one + "/device", RouteAccess::roles, reamers},
          {"GET", one + "/recording", RouteAccess::roles, reamers},
          {"GET", one + "/session.json", RouteAccess::roles, reamers},
          {"GET", one + "/trace", RouteAccess::roles, reamers},
          {"GET", one + "/mesh", RouteAccess::roles, reamers},
          {"GET", one + "/snapshot", RouteAccess::roles, reamers},
          {"POST", one + "/exports", RouteAccess::roles, reamers},
          {"GET", one + "/score", RouteAccess::roles, all_roles},
          {"POST", one + "/score", RouteAccess::roles, staff},
          {"GET", one + "/deviation", RouteAccess::roles, reamers},
          {"GET", "/api/v1/events", RouteAccess::roles, all_roles}};
}

std::vector<Right> study_rows() {
  const std::string studies = "/api/v1/studies", one = studies + "/{id}";
  const std::string participants = one + "/participants", participant = participants + "/{code}";
  return {{"GET", studies, RouteAccess::roles, reamers},
          {"POST", studies, RouteAccess::roles, staff},
          {"POST", studies + "/join", RouteAccess::roles, reamers},
          {"GET", one, RouteAccess::roles, reamers},
          {"PUT", one, RouteAccess::roles, staff},
          {"DELETE", one, RouteAccess::roles, operators},
          {"POST", one + "/close", RouteAccess::roles, staff},
          {"POST", one + "/reopen", RouteAccess::roles, staff},
          {"POST", one + "/unblind", RouteAccess::roles, operators},
          {"GET", participants, RouteAccess::roles, staff},
          {"POST", participants, RouteAccess::roles, staff},
          {"GET", participant, RouteAccess::roles, reamers},
          {"DELETE", participant, RouteAccess::roles, operators},
          {"PUT", participant + "/answers", RouteAccess::roles, reamers},
          {"GET", one + "/persons", RouteAccess::roles, staff},
          {"GET", one + "/codebook", RouteAccess::roles, staff},
          {"GET", one + "/export", RouteAccess::roles, staff}};
}

std::vector<Right> score_rows() {
  const std::string rubrics = "/api/v1/rubrics", benchmarks = "/api/v1/benchmarks";
  return {{"GET", rubrics, RouteAccess::roles, reamers},
          {"POST", rubrics, RouteAccess::roles, staff},
          {"GET", rubrics + "/{id}", RouteAccess::roles, reamers},
          {"PUT", rubrics + "/{id}", RouteAccess::roles, staff},
          {"GET", benchmarks, RouteAccess::roles, reamers},
          {"POST", benchmarks, RouteAccess::roles, staff},
          {"GET", benchmarks + "/{id}", RouteAccess::roles, reamers},
          {"GET", "/api/v1/scores", RouteAccess::roles, reamers},
          {"POST", "/api/v1/rescorings", RouteAccess::roles, staff},
          {"GET", "/api/v1/learning", RouteAccess::roles, reamers}};
}

}  // namespace

const std::vector<Right>& rights() {
  static const std::vector<Right> all = [] {
    std::vector<Right> rows;
    for (const auto& part :
         {open_rows(), access_rows(), case_rows(), session_rows(), study_rows(), score_rows()})
      rows.insert(rows.end(), part.begin(), part.end());
    return rows;
  }();
  return all;
}

const Right* right_of(const std::string& method, const std::string& pattern) {
  const std::string asked = method == "HEAD" ? "GET" : method;
  const auto row = std::find_if(rights().begin(), rights().end(), [&](const Right& right) {
    return right.method == asked && right.pattern == pattern;
  });
  return row == rights().end() ? nullptr : &*row;
}

}  // namespace ream::api
