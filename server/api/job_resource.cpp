#include <nlohmann/json.hpp>

#include "access/role.hpp"
#include "api/json_page.hpp"
#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "api/visibility.hpp"
#include "core/text.hpp"
#include "net/file_body.hpp"
#include "net/problem.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

/// A file's name may be a patient's: others than its sender and operators do not learn why an import failed.
bool may_read_problem(const net::Caller& caller, const jobs::JobRecord& job) {
  return !job.order.sender || caller.role == "operator" || *job.order.sender == caller.user_id;
}

json job_json(const net::Caller& caller, const jobs::JobRecord& job) {
  json problem, result;
  if (job.state == jobs::JobState::failed) {
    const int status = net::http_status(job.problem_kind);
    problem = {{"status", status},
               {"title", net::status_title(status)},
               {"detail", may_read_problem(caller, job)
                              ? job.problem
                              : "the file could not be imported; who sent it and operators see why"}};
  }
  if (job.result)
    result = {{"name", job.result->path.filename().string()},
              {"media_type", job.result->media_type},
              {"bytes", job.result->bytes}};
  return {{"id", job.id},
          {"number", job.number},
          {"kind", job.order.kind},
          {"case_id", or_null(job.order.case_id)},
          {"session_id", or_null(job.order.session_id)},
          {"state", to_text(job.state)},
          {"share", job.share},
          {"step", job.step},
          {"problem", std::move(problem)},
          {"created_utc", job.created_utc},
          {"ended_utc", or_null(job.ended_utc)},
          {"result", std::move(result)}};
}

/// Operators and instructors may know of all work but that on sessions that they rate or whose results are
/// hidden from them, others of that on sessions that they may see.
bool may_see_job(const Services& services, const net::Caller& caller, const jobs::JobRecord& job) {
  if (job.order.session &&
      (services.ratings.hides(caller, *job.order.session) || services.feel.hides(caller, *job.order.session)))
    return false;
  if ((access::role_bit(caller.role) & access::staff) != 0) return true;
  return job.order.session && may_see(caller, *job.order.session);
}

bool fits(const net::Request& request, const std::string& name, const std::string& value) {
  const auto wanted = request.query.find(name);
  return wanted == request.query.end() || wanted->second == value;
}

net::Response list_jobs(const Services& services, const net::Request& request) {
  std::vector<json> list;
  for (const jobs::JobRecord& job : services.jobs.list())
    if (may_see_job(services, request.caller, job) && fits(request, "case_id", job.order.case_id) &&
        fits(request, "session_id", job.order.session_id) && fits(request, "kind", job.order.kind) &&
        fits(request, "state", to_text(job.state)))
      list.push_back(job_json(request.caller, job));
  return page_of(request, "jobs", std::move(list), "-number");
}

/// In the words of a job that does not exist unless the caller may know of it.
jobs::JobRecord seen_job(const Services& services, const net::Request& request) {
  jobs::JobRecord job = services.jobs.get(id_of(request));
  if (!may_see_job(services, request.caller, job))
    throw Error(ErrorKind::not_found, "no job '" + job.id + "'");
  return job;
}

net::Response get_job_result(const Services& services, const net::Request& request) {
  const jobs::JobRecord job = seen_job(services, request);
  if (jobs::is_open(job.state))
    throw Error(ErrorKind::conflict, "job '" + job.id + "' is " + to_text(job.state) + "; wait for its end");
  if (!job.result) throw Error(ErrorKind::not_found, "job '" + job.id + "' has no file, or has it no longer");
  return net::file_response(request,
                            {job.result->path, job.result->media_type, job.result->path.filename().string()});
}

net::Response get_job(const Services& services, const net::Request& request) {
  return net::json_response(200, job_json(request.caller, seen_job(services, request)));
}

net::Response cancel_job(const Services& services, const net::Request& request) {
  return net::json_response(202,
                            job_json(request.caller, services.jobs.cancel(seen_job(services, request).id)));
}

}  // namespace

net::Response accepted(const net::Caller& caller, const jobs::JobRecord& job) {
  net::Response response = net::json_response(202, job_json(caller, job));
  response.headers.emplace_back("Location", "/api/v1/jobs/" + job.id);
  return response;
}

std::vector<Route> job_routes() {
  using access::reamers;
  const std::string all = "/api/v1/jobs", one = all + "/{id}";
  return {{"GET", all, reamers, not_audited, list_jobs},
          {"GET", one, reamers, not_audited, get_job},
          {"DELETE", one, reamers, changes("job.cancel"), cancel_job},
          {"GET", one + "/result", reamers, reads("job.result"), get_job_result}};
}

}  // namespace ream::api
