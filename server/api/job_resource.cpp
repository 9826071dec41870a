#include "api/job_resource.hpp"

#include <nlohmann/json.hpp>

#include "api/request_body.hpp"
#include "net/problem.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

json to_json(const JobRecord& job) {
  json problem;
  if (job.state == JobState::failed) {
    const int status = net::http_status(job.problem_kind);
    problem = {{"status", status}, {"title", net::status_title(status)}, {"detail", job.problem}};
  }
  return {
      {"id", job.id},       {"kind", job.kind}, {"case_id", job.case_id},       {"state", to_text(job.state)},
      {"share", job.share}, {"step", job.step}, {"problem", std::move(problem)}};
}

net::Response list(const JobService& jobs, const net::Request& request) {
  const auto wanted = request.query.find("case_id");
  json list = json::array();
  for (const JobRecord& job : jobs.list(wanted == request.query.end() ? "" : wanted->second))
    list.push_back(to_json(job));
  return net::json_response(200, {{"jobs", std::move(list)}});
}

}  // namespace

net::Response accepted(const JobRecord& job) {
  net::Response response = net::json_response(202, to_json(job));
  response.headers.emplace_back("Location", "/api/v1/jobs/" + job.id);
  return response;
}

void add_job_routes(net::Router& router, JobService& jobs) {
  router.on("GET", "/api/v1/jobs", [&jobs](const net::Request& request) { return list(jobs, request); });
  router.on("GET", "/api/v1/jobs/{id}", [&jobs](const net::Request& request) {
    return net::json_response(200, to_json(jobs.get(request.parameters.at("id"))));
  });
  router.on("DELETE", "/api/v1/jobs/{id}", [&jobs](const net::Request& request) {
    return net::json_response(202, to_json(jobs.cancel(request.parameters.at("id"))));
  });
}

}  // namespace ream::api
