#include <nlohmann/json.hpp>

#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "api/session_list.hpp"
#include "api/session_work.hpp"
#include "core/error.hpp"
#include "core/file.hpp"

namespace ream::api {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

/// What a job does; everything it needs, as it outlives the request.
struct Rescoring {
  session::SessionService* sessions;
  ChangeFeed* feed;
  session::SessionEngine* engine;
  session::Judge judge;
  std::vector<std::string> ids;
};

/// By ids, or by the filters of the list of sessions, of which those that have ended are meant.
std::vector<std::string> ids_by_filter(const Services& services, const net::Request& request,
                                       const json& filter) {
  net::Request as_list = request;
  as_list.query.clear();
  for (const auto& [key, value] : filter.items())
    as_list.query[key] = value.is_string() ? value.get<std::string>() : value.dump();
  store::SessionQuery query = session_query(as_list);
  query.limit = SIZE_MAX;
  std::vector<std::string> ids;
  for (const session::SessionRecord& record : sessions_for(services, request.caller, query).sessions)
    if (!is_live(record.status.state) && !services.feel.hides(request.caller, record.request))
      ids.push_back(record.request.id);
  return ids;
}

std::vector<std::string> ids_named(const Services& services, const net::Request& request,
                                   const std::vector<std::string>& named) {
  for (const std::string& id : named) {
    services.authorizer.require_results(request.caller, id);
    require_ended(services.sessions.get(id), "it can be scored anew when it has ended");
  }
  return named;
}

json rescored(const Rescoring& all, const std::string& id, session::SessionMeasurer& measurer,
              const Progress& progress) {
  const session::SessionRecord record = all.sessions->get(id);
  const fs::path folder = all.sessions->folder_of(id);
  const FileLock lock = lock_of_ended(folder);
  const json metrics = measurer.metrics(folder, progress);
  const json document = session::score_document(
      all.engine->program(), read_json_file(session::session_json(folder)), metrics, all.judge);
  session::write_results(folder, metrics, document);
  all.sessions->note_results(id);
  all.feed->publish(
      {"session", id, "scored", std::make_shared<const session::SessionRequest>(record.request)});
  const json& score = document.at("score");
  return {{"session", id}, {"points", score.at("points")}, {"outcome", score.at("outcome")}};
}

/// A session that cannot be scored does not stop the others.
json rescore_all(const Rescoring& all, const Progress& progress) {
  const auto measurer = all.engine->measurer();
  json scored = json::array(), failed = json::array();
  const double step = 1.0 / static_cast<double>(all.ids.size());
  for (const std::string& id : all.ids) {
    const double begun = static_cast<double>(scored.size() + failed.size()) * step;
    const std::string words = "session " + std::to_string(scored.size() + failed.size() + 1) + " of " +
                              std::to_string(all.ids.size());
    const Progress of_this = [&](double share, std::string_view) { progress(begun + share * step, words); };
    of_this(0.0, {});
    try {
      scored.push_back(rescored(all, id, *measurer, of_this));
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::cancelled) throw;
      failed.push_back({{"session", id}, {"error", error.what()}});
    }
  }
  progress(1.0, "done");
  return {{"rubric", {{"id", all.judge.rubric_id}, {"version", all.judge.rubric.version}}},
          {"scored", std::move(scored)},
          {"failed", std::move(failed)}};
}

net::Response begin_rescoring(const Services& services, const net::Request& request) {
  const json& body = body_of(request);
  const bool by_name = body.contains("sessions");
  const std::vector<std::string> named = different_texts_in(body, "sessions");
  if (by_name == body.contains("filter"))
    throw net::RequestError(422, "say either 'sessions' or 'filter'; an empty filter means all sessions",
                            {{"#/sessions", "or filter: one of them"}});
  Rescoring all{
      &services.sessions, &services.feed, &services.engine,
      services.stores.judge_by(text_in(body, "rubric"), text_in(body, "benchmark")),
      by_name ? ids_named(services, request, named) : ids_by_filter(services, request, body.at("filter"))};
  if (all.ids.empty())
    throw net::RequestError(422, "no session that has ended fits the filter", {{"#/filter", "fits nothing"}});
  services.audit(request, "session.rescore", "",
                 std::to_string(all.ids.size()) + " sessions by " + all.judge.rubric_id + "@" +
                     std::to_string(all.judge.rubric.version));
  return accepted(request.caller,
                  services.jobs.submit_file({"rescoring"}, [all = std::move(all)](const fs::path& folder,
                                                                                  const Progress& progress) {
                    const json report = rescore_all(all, progress);
                    write_file_atomically(folder / "rescoring.json", report.dump(2) + "\n");
                    return jobs::JobService::MadeFile{"rescoring.json", "application/json"};
                  }));
}

}  // namespace

std::vector<Route> rescoring_routes() {
  return {{"POST", "/api/v1/rescorings", access::staff, audited_by_handler, begin_rescoring}};
}

}  // namespace ream::api
