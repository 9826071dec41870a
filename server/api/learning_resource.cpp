#include <nlohmann/json.hpp>

#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "api/session_list.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "net/problem.hpp"
#include "session/scoring/ended_sessions.hpp"

namespace ream::api {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

/// Of one person: by user, by the code of a study, or by the name that was given where there are no users.
store::SessionQuery query_of(const net::Request& request) {
  store::SessionQuery query;
  query.trainee_id = query_text(request, "trainee");
  query.participant = query_text(request, "participant");
  query.text = query_text(request, "name");
  query.outside_studies = !query.text.empty();
  query.case_id = query_text(request, "case");
  if (request.caller.role == "trainee") {
    if (!query.trainee_id.empty() && query.trainee_id != request.caller.user_id)
      throw Error(ErrorKind::not_found,
                  "no such trainee that you may see; a trainee has their own learning only");
  } else if (int{!query.trainee_id.empty()} + int{!query.participant.empty()} + int{!query.text.empty()} !=
             1) {
    throw net::RequestError(
        422,
        "say whose learning: either 'trainee', a user's id, or 'participant', a code of a "
        "study, or 'name', as sessions without a user have it");
  }
  query.descending = false;
  query.limit = SIZE_MAX;
  return query;
}

/// Whether it is of the person who is called so, and of no user.
bool is_named(const session::SessionRecord& record, const std::string& name) {
  return record.request.trainee_id.empty() && record.request.trainee == name;
}

/// Those that have left metrics, and in which somebody reamed.
std::vector<session::EndedSession> attempts_of(const Services& services, const net::Request& request) {
  std::vector<session::EndedSession> attempts;
  const std::string name = query_text(request, "name");
  for (const session::SessionRecord& record :
       sessions_for(services, request.caller, query_of(request)).sessions) {
    if (!name.empty() && !is_named(record, name)) continue;
    const std::string& id = record.request.id;
    const fs::path folder = services.sessions.folder_of(id);
    std::error_code failed;
    if (is_live(record.status.state) || !fs::exists(session::metrics_json(folder), failed)) continue;
    session::EndedSession ended{id,
                                {{"created_utc", record.request.created_utc},
                                 {"theatre", record.request.theatre},
                                 {"case", record.request.case_id},
                                 {"device", record.request.device}},
                                read_json_file(session::metrics_json(folder))};
    if (session::is_attempt(ended)) attempts.push_back(std::move(ended));
  }
  return attempts;
}

/// Proficiency-based progression: in which sessions all lines were reached.
json progression(const std::string& id, const score::Benchmark& benchmark,
                 const std::vector<session::EndedSession>& attempts) {
  json sessions = json::array();
  json first;
  for (const session::EndedSession& attempt : attempts) {
    size_t reached = 0;
    for (const score::BenchmarkResult& result : score::compare_with(benchmark, attempt.metrics))
      reached += result.reached ? 1 : 0;
    const bool all = reached == benchmark.lines.size();
    if (all && first.is_null()) first = attempt.id;
    sessions.push_back({{"session", attempt.id}, {"reached", reached}, {"proficient", all}});
  }
  const bool proficient = !sessions.empty() && sessions.back().at("proficient").get<bool>();
  return {{"id", id},
          {"name", benchmark.name},
          {"of", benchmark.lines.size()},
          {"proficient", proficient},
          {"first_proficient", first},
          {"sessions", std::move(sessions)}};
}

net::Response get_learning(const Services& services, const net::Request& request) {
  const std::string benchmark = query_text(request, "benchmark");
  const session::Judge judge = services.stores.judge_by(query_text(request, "rubric"), benchmark);
  score::CusumParameters cusum;
  cusum.acceptable_rate = query_number(request, "acceptable_rate", cusum.acceptable_rate);
  cusum.unacceptable_rate = query_number(request, "unacceptable_rate", cusum.unacceptable_rate);
  cusum.alpha = query_number(request, "alpha", cusum.alpha);
  cusum.beta = query_number(request, "beta", cusum.beta);
  score::cusum_limits(cusum);
  std::vector<session::EndedSession> attempts;
  std::vector<score::LearningPoint> points;
  services.executor.run([&] {
    attempts = attempts_of(services, request);
    for (const session::EndedSession& attempt : attempts)
      points.push_back(session::learning_point(attempt, score::apply_rubric(judge.rubric, attempt.metrics)));
  });
  json view = score::learning_json(score::learning_curve(cusum, std::move(points)));
  for (json& session : view["sessions"])
    if (!session.contains("standing")) session["standing"] = nullptr;
  view["rubric"] = {{"id", judge.rubric_id}, {"version", judge.rubric.version}};
  view["benchmark"] = judge.benchmark ? progression(benchmark, *judge.benchmark, attempts) : json(nullptr);
  return net::json_response(200, view);
}

}  // namespace

std::vector<Route> learning_routes() {
  return {{"GET", "/api/v1/learning", access::reamers, reads("scores.read"), get_learning}};
}

}  // namespace ream::api
