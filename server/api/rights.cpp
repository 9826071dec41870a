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
    rows.push_back({"GET", pattern, Door::anybody});
  rows.push_back({"POST", "/api/v1/login", Door::anybody});
  rows.push_back({"DELETE", "/api/v1/login", Door::anybody});
  rows.push_back({"POST", "/api/v1/login/link", Door::anybody});
  rows.push_back({"GET", "/metrics", Door::gauges, operators});
  return rows;
}

std::vector<Right> access_rows() {
  const std::string users = "/api/v1/users", user = users + "/{id}";
  const std::string tokens = "/api/v1/tokens", links = "/api/v1/links";
  return {{"POST", "/api/v1/login/password", Door::roles, reamers},
          {"GET", users, Door::roles, staff},
          {"POST", users, Door::roles, operators},
          {"GET", user, Door::roles, staff},
          {"PATCH", user, Door::roles, operators},
          {"DELETE", user, Door::roles, operators},
          {"GET", tokens, Door::roles, reamers},
          {"POST", tokens, Door::roles, reamers},
          {"DELETE", tokens + "/{id}", Door::roles, reamers},
          {"GET", links, Door::roles, staff},
          {"POST", links, Door::roles, staff},
          {"DELETE", links + "/{id}", Door::roles, staff},
          {"GET", "/api/v1/audit", Door::roles, operators}};
}

std::vector<Right> case_rows() {
  const std::string uploads = "/api/v1/uploads", upload = uploads + "/{id}";
  const std::string jobs = "/api/v1/jobs", cases = "/api/v1/cases", one = cases + "/{id}";
  return {{"GET", uploads, Door::roles, staff},
          {"POST", uploads, Door::roles, staff},
          {"GET", upload, Door::roles, staff},
          {"PUT", upload, Door::roles, staff},
          {"DELETE", upload, Door::roles, staff},
          {"GET", jobs, Door::roles, reamers},
          {"GET", jobs + "/{id}", Door::roles, reamers},
          {"GET", jobs + "/{id}/result", Door::roles, reamers},
          {"DELETE", jobs + "/{id}", Door::roles, reamers},
          {"GET", cases, Door::roles, reamers},
          {"POST", cases, Door::roles, staff},
          {"GET", one, Door::roles, reamers},
          {"DELETE", one, Door::roles, staff},
          {"GET", one + "/volume", Door::roles, reamers},
          {"GET", one + "/landmarks", Door::roles, reamers},
          {"GET", one + "/plan", Door::roles, reamers},
          {"GET", one + "/volume/slices/{axis}/{index}", Door::roles, reamers},
          {"GET", one + "/mesh", Door::roles, reamers},
          {"POST", one + "/segmentation", Door::roles, staff},
          {"POST", one + "/segmentation/undo", Door::roles, staff},
          {"POST", one + "/build", Door::roles, staff},
          {"PUT", one + "/landmarks", Door::roles, staff},
          {"GET", one + "/measures", Door::roles, reamers},
          {"PUT", one + "/plan", Door::roles, staff},
          {"POST", one + "/plan/proposal", Door::roles, staff},
          {"GET", "/api/v1/reamers", Door::roles, reamers}};
}

std::vector<Right> session_rows() {
  const std::string sessions = "/api/v1/sessions", one = sessions + "/{id}";
  return {{"GET", sessions, Door::roles, all_roles},
          {"POST", sessions, Door::roles, reamers},
          {"GET", one, Door::roles, all_roles},
          {"PATCH", one, Door::roles, reamers},
          {"DELETE", one, Door::roles, reamers},
          {"POST", one + "/restore", Door::roles, staff},
          {"GET", "/api/v1/trash", Door::roles, staff},
          {"POST", one + "/start", Door::roles, reamers},
          {"POST", one + "/pause", Door::roles, reamers},
          {"POST", one + "/reset", Door::roles, reamers},
          {"POST", one + "/stop", Door::roles, reamers},
          {"POST", one + "/resume", Door::roles, reamers},
          {"GET", one + "/annotations", Door::roles, all_roles},
          {"POST", one + "/annotations", Door::roles, reamers},
          {"POST", one + "/replay", Door::roles, all_roles},
          {"POST", one + "/playback", Door::roles, all_roles},
          {"GET", one + "/metrics", Door::roles, all_roles},
          {"GET", one + "/stream", Door::roles, all_roles},
          {"GET", one + "/device", Door::roles, reamers},
          {"GET", one + "/recording", Door::roles, reamers},
          {"GET", one + "/session.json", Door::roles, reamers},
          {"GET", one + "/trace", Door::roles, reamers},
          {"GET", one + "/mesh", Door::roles, reamers},
          {"GET", one + "/snapshot", Door::roles, reamers},
          {"POST", one + "/exports", Door::roles, reamers},
          {"GET", one + "/score", Door::roles, all_roles},
          {"POST", one + "/score", Door::roles, staff},
          {"GET", one + "/deviation", Door::roles, reamers},
          {"GET", "/api/v1/events", Door::roles, all_roles}};
}

std::vector<Right> study_rows() {
  const std::string studies = "/api/v1/studies", one = studies + "/{id}";
  const std::string participants = one + "/participants", participant = participants + "/{code}";
  return {{"GET", studies, Door::roles, reamers},
          {"POST", studies, Door::roles, staff},
          {"POST", studies + "/join", Door::roles, reamers},
          {"GET", one, Door::roles, reamers},
          {"PUT", one, Door::roles, staff},
          {"DELETE", one, Door::roles, operators},
          {"POST", one + "/close", Door::roles, staff},
          {"POST", one + "/reopen", Door::roles, staff},
          {"POST", one + "/unblind", Door::roles, operators},
          {"GET", participants, Door::roles, staff},
          {"POST", participants, Door::roles, staff},
          {"GET", participant, Door::roles, reamers},
          {"DELETE", participant, Door::roles, operators},
          {"PUT", participant + "/answers", Door::roles, reamers},
          {"GET", one + "/persons", Door::roles, staff},
          {"GET", one + "/codebook", Door::roles, staff},
          {"GET", one + "/export", Door::roles, staff}};
}

std::vector<Right> score_rows() {
  const std::string rubrics = "/api/v1/rubrics", benchmarks = "/api/v1/benchmarks";
  return {{"GET", rubrics, Door::roles, reamers},
          {"POST", rubrics, Door::roles, staff},
          {"GET", rubrics + "/{id}", Door::roles, reamers},
          {"PUT", rubrics + "/{id}", Door::roles, staff},
          {"GET", benchmarks, Door::roles, reamers},
          {"POST", benchmarks, Door::roles, staff},
          {"GET", benchmarks + "/{id}", Door::roles, reamers},
          {"GET", "/api/v1/scores", Door::roles, reamers},
          {"POST", "/api/v1/rescorings", Door::roles, staff},
          {"GET", "/api/v1/learning", Door::roles, reamers}};
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
