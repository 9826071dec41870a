#include <nlohmann/json.hpp>

#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "api/session_list.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "net/problem.hpp"
#include "score/learning_curve.hpp"

namespace ream::api {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

/// A session of a trainee that has ended and left metrics.
struct Attempt {
  score::LearningPoint point;
  json metrics;
};

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

std::vector<Attempt> attempts_of(const Services& services, const net::Request& request,
                                 const score::Rubric& rubric) {
  std::vector<Attempt> attempts;
  const std::string name = query_text(request, "name");
  for (const session::SessionRecord& record :
       sessions_for(request.caller, services.sessions, query_of(request)).sessions) {
    if (!name.empty() && !is_named(record, name)) continue;
    const std::string& id = record.request.id;
    const fs::path folder = services.sessions.folder_of(id);
    std::error_code failed;
    if (is_live(record.status.state) || !fs::exists(session::metrics_json(folder), failed)) continue;
    Attempt attempt;
    attempt.metrics = read_json_file(session::metrics_json(folder));
    const score::Score score = score::apply_rubric(rubric, attempt.metrics);
    attempt.point = {
        id, record.request.created_utc, record.request.theatre, score.points, score.outcome, std::nullopt};
    attempts.push_back(std::move(attempt));
  }
  return attempts;
}

/// Proficiency-based progression: in which sessions all lines were reached.
json progression(const std::string& id, const score::Benchmark& benchmark,
                 const std::vector<Attempt>& attempts) {
  json sessions = json::array();
  json first;
  for (const Attempt& attempt : attempts) {
    size_t reached = 0;
    for (const score::BenchmarkResult& result : score::compare_with(benchmark, attempt.metrics))
      reached += result.reached ? 1 : 0;
    const bool all = reached == benchmark.lines.size();
    if (all && first.is_null()) first = attempt.point.session;
    sessions.push_back({{"session", attempt.point.session}, {"reached", reached}, {"proficient", all}});
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
  std::vector<Attempt> attempts;
  services.executor.run([&] { attempts = attempts_of(services, request, judge.rubric); });
  std::vector<score::LearningPoint> points;
  for (const Attempt& attempt : attempts) points.push_back(attempt.point);
  json told = score::learning_json(score::learning_curve(cusum, std::move(points)));
  for (json& session : told["sessions"])
    if (!session.contains("standing")) session["standing"] = nullptr;
  told["rubric"] = {{"id", judge.rubric_id}, {"version", judge.rubric.version}};
  told["benchmark"] = judge.benchmark ? progression(benchmark, *judge.benchmark, attempts) : json(nullptr);
  return net::json_response(200, told);
}

}  // namespace

std::vector<Route> learning_routes() {
  return {{"GET", "/api/v1/learning", access::reamers, reads("scores.read"), get_learning}};
}

}  // namespace ream::api
