#include <nlohmann/json.hpp>

#include "access/role.hpp"
#include "api/request_body.hpp"
#include "api/score_tools.hpp"
#include "core/error.hpp"
#include "score/group_cut.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

const std::string base = "/api/v1/benchmarks";
constexpr size_t max_benchmark_name = 200, longest_rubric = 72, most_sessions = 1000, fewest_to_contrast = 3;

json text_or_null(const std::string& text) { return text.empty() ? json(nullptr) : json(text); }

json summary_json(const score::KeptBenchmark& kept) {
  return {{"id", kept.id},
          {"name", kept.benchmark.name},
          {"created_utc", kept.created_utc},
          {"experts", kept.benchmark.sessions.size()},
          {"novices", kept.novices.size()},
          {"metrics", kept.benchmark.lines.size()}};
}

/// Trainees get no ids of others' sessions.
json benchmark_json(const score::KeptBenchmark& kept, const net::Caller& caller) {
  const bool to_staff = (access::role_bit(caller.role) & access::staff) != 0;
  json lines = score::benchmark_json(kept.benchmark).at("metrics");
  for (json& line : lines)
    if (!to_staff) line["dropped"] = json::array();
  json told = summary_json(kept);
  told["expert_sessions"] = to_staff ? json(kept.benchmark.sessions) : json(nullptr);
  told["novice_sessions"] = to_staff ? json(kept.novices) : json(nullptr);
  told["rubric"] = text_or_null(kept.rubric);
  told["density"] = text_or_null(kept.density);
  told["lines"] = std::move(lines);
  told["cuts"] = kept.cuts;
  return told;
}

/// What sessions say; each must have ended and left metrics. `key` names them in the request.
std::vector<score::MeasuredSession> measured(const ScoreTools& tools, const std::vector<std::string>& ids,
                                             const std::string& key) {
  std::vector<score::MeasuredSession> sessions;
  for (size_t i = 0; i < ids.size(); ++i) {
    const auto refuse = [&](const std::string& why) {
      throw net::RequestError(422, "session '" + ids[i] + "' " + why,
                              {{pointer_to(key) + "/" + std::to_string(i), why}});
    };
    try {
      if (is_live(tools.sessions.get(ids[i]).status.state)) refuse("has not ended");
      sessions.push_back({ids[i], tools.sessions.metrics(ids[i])});
    } catch (const net::RequestError&) {
      throw;
    } catch (const Error& missing) {
      if (missing.kind() != ErrorKind::not_found) throw;
      refuse("is not there, or left no metrics");
    }
  }
  return sessions;
}

struct Wishes {
  std::string name, rubric;
  score::Density density = score::Density::normal;
  std::vector<std::string> experts, novices;
};

Wishes wishes_in(const net::Request& request) {
  RequestBody body(request);
  Wishes wishes;
  wishes.name = body.words("name", 1, max_benchmark_name);
  wishes.experts = body.names("experts", 1, most_sessions);
  const bool contrasted = body.value_or_none("novices").has_value();
  if (contrasted) wishes.novices = body.names("novices", fewest_to_contrast, most_sessions);
  wishes.rubric = body.words("rubric", 0, longest_rubric);
  const std::string density =
      body.value_or_none("density") ? body.one_of("density", {"normal", "kernel"}) : "normal";
  body.finish();
  wishes.density = score::density_from_text(density);
  if (contrasted && wishes.experts.size() < fewest_to_contrast)
    throw net::RequestError(422, "pass marks need three sessions of experts and three of novices",
                            {{"#/experts", "must have three or more to be contrasted"}});
  return wishes;
}

net::Response create(const ScoreTools& tools, const net::Request& request) {
  const Wishes wishes = wishes_in(request);
  const session::Judge judge = tools.stores.judge_by(wishes.rubric);
  score::KeptBenchmark made;
  tools.executor.run([&] {
    const auto experts = measured(tools, wishes.experts, "experts");
    const auto novices = measured(tools, wishes.novices, "novices");
    made.benchmark = score::make_benchmark(wishes.name, experts);
    if (novices.empty()) return;
    made.novices = wishes.novices;
    made.rubric = judge.rubric_id + "@" + std::to_string(judge.rubric.version);
    made.density = score::to_text(wishes.density);
    made.cuts = score::group_cuts_json(novices, experts, judge.rubric, wishes.density);
  });
  if (made.benchmark.lines.empty())
    throw net::RequestError(422, "the experts' sessions say nothing that others could be compared with",
                            {{"#/experts", "say no metric that has an aim"}});
  const score::KeptBenchmark kept = tools.stores.benchmarks.keep(std::move(made));
  tools.audit(request, "benchmark.create", kept.id, kept.benchmark.name);
  net::Response response = net::json_response(201, benchmark_json(kept, request.caller));
  response.headers.emplace_back("Location", base + "/" + kept.id);
  return response;
}

}  // namespace

void add_benchmark_routes(net::Router& router, const ScoreTools& tools) {
  router.on("GET", base, [tools](const net::Request&) {
    json benchmarks = json::array();
    for (const score::KeptBenchmark& kept : tools.stores.benchmarks.list())
      benchmarks.push_back(summary_json(kept));
    return net::json_response(200, {{"benchmarks", std::move(benchmarks)}});
  });
  router.on("POST", base, [tools](const net::Request& request) { return create(tools, request); });
  router.on("GET", base + "/{id}", [tools](const net::Request& request) {
    return net::json_response(
        200, benchmark_json(tools.stores.benchmarks.get(request.parameters.at("id")), request.caller));
  });
}

}  // namespace ream::api
