#include <nlohmann/json.hpp>

#include "access/role.hpp"
#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "core/text.hpp"
#include "net/problem.hpp"
#include "score/group_cut.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

const std::string benchmarks_path = "/api/v1/benchmarks";
constexpr size_t min_to_contrast = 3;

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
  json view = summary_json(kept);
  view["expert_sessions"] = to_staff ? json(kept.benchmark.sessions) : json(nullptr);
  view["novice_sessions"] = to_staff ? json(kept.novices) : json(nullptr);
  view["rubric"] = or_null(kept.rubric);
  view["density"] = or_null(kept.density);
  view["lines"] = std::move(lines);
  view["cuts"] = kept.cuts;
  return view;
}

/// What sessions say; each must have ended and left metrics. `key` names them in the request.
std::vector<score::EndedSession> measured(const Services& services, const net::Request& request,
                                          const std::vector<std::string>& ids, const std::string& key) {
  std::vector<score::EndedSession> sessions;
  for (size_t i = 0; i < ids.size(); ++i) {
    const auto refuse = [&](const std::string& why) {
      throw net::RequestError(422, "session '" + ids[i] + "' " + why,
                              {{pointer_to(key) + "/" + std::to_string(i), why}});
    };
    services.authorizer.require_results(request.caller, ids[i]);
    try {
      if (is_live(services.sessions.get(ids[i]).status.state)) refuse("has not ended");
      sessions.push_back({ids[i], nullptr, services.sessions.metrics(ids[i])});
    } catch (const net::RequestError&) {
      throw;
    } catch (const Error& missing) {
      if (missing.kind() != ErrorKind::not_found) throw;
      refuse("is not there, or left no metrics");
    }
  }
  return sessions;
}

struct BenchmarkRequest {
  std::string name, rubric;
  score::Density density = score::Density::normal;
  std::vector<std::string> experts, novices;
};

BenchmarkRequest benchmark_request_in(const json& body) {
  BenchmarkRequest wanted{body.at("name"), text_in(body, "rubric"),
                          score::density_from_text(body.value("density", "normal")),
                          different_texts_in(body, "experts"), different_texts_in(body, "novices")};
  if (!wanted.novices.empty() && wanted.experts.size() < min_to_contrast)
    throw net::RequestError(422, "pass marks need three sessions of experts and three of novices",
                            {{"#/experts", "must have three or more to be contrasted"}});
  return wanted;
}

net::Response create_benchmark(const Services& services, const net::Request& request) {
  const BenchmarkRequest wanted = benchmark_request_in(body_of(request));
  const session::Judge judge = services.stores.judge_by(wanted.rubric);
  score::KeptBenchmark made;
  services.executor.run([&] {
    const auto experts = measured(services, request, wanted.experts, "experts");
    const auto novices = measured(services, request, wanted.novices, "novices");
    made.benchmark = score::make_benchmark(wanted.name, experts);
    if (novices.empty()) return;
    made.novices = wanted.novices;
    made.rubric = judge.rubric_id + "@" + std::to_string(judge.rubric.version);
    made.density = score::to_text(wanted.density);
    made.cuts = score::group_cuts_json(novices, experts, judge.rubric, wanted.density);
  });
  if (made.benchmark.lines.empty())
    throw net::RequestError(422, "the experts' sessions say nothing that others could be compared with",
                            {{"#/experts", "say no metric that has an aim"}});
  const score::KeptBenchmark kept = services.stores.benchmarks.keep(std::move(made));
  services.audit(request, "benchmark.create", kept.id, kept.benchmark.name);
  return created(benchmarks_path + "/" + kept.id, benchmark_json(kept, request.caller));
}

net::Response list_benchmarks(const Services& services, const net::Request&) {
  json benchmarks = json::array();
  for (const score::KeptBenchmark& kept : services.stores.benchmarks.list())
    benchmarks.push_back(summary_json(kept));
  return net::json_response(200, {{"benchmarks", std::move(benchmarks)}});
}

net::Response get_benchmark(const Services& services, const net::Request& request) {
  return net::json_response(200,
                            benchmark_json(services.stores.benchmarks.get(id_of(request)), request.caller));
}

}  // namespace

std::vector<Route> benchmark_routes() {
  return {{"GET", benchmarks_path, access::reamers, not_audited, list_benchmarks},
          {"POST", benchmarks_path, access::staff, audited_by_handler, create_benchmark},
          {"GET", benchmarks_path + "/{id}", access::reamers, not_audited, get_benchmark}};
}

}  // namespace ream::api
