#include <nlohmann/json.hpp>

#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "api/session_list.hpp"
#include "api/session_work.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "session/scoring/score_table.hpp"

namespace ream::api {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

/// What a score says of the session itself, which has no file before its start.
json about(const session::SessionRecord& record) { return {{"theatre", record.request.theatre}}; }

net::Response score_response(const std::string& id, const std::string& standing, const json& document) {
  json score = session::explained_score(document);
  score["session"] = id;
  score["standing"] = standing;
  return net::json_response(200, score);
}

/// As it is kept where nobody asks for another rubric, else made now.
net::Response get_score(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  const session::SessionRecord record = services.sessions.get(id);
  const fs::path folder = services.sessions.folder_of(id);
  const bool live = is_live(record.status.state);
  const std::string rubric = query_text(request, "rubric"), benchmark = query_text(request, "benchmark");
  std::error_code failed;
  if (!live && rubric.empty() && benchmark.empty() && fs::exists(session::score_json(folder), failed))
    return score_response(id, "kept", read_json_file(session::score_json(folder)));
  session::Judge judge = services.stores.judge_by(rubric, benchmark);
  judge.by_plugin = !live;  // it is promised to be asked of what has ended
  const json metrics = services.sessions.metrics(id);
  return score_response(id, live ? "live" : "computed",
                        session::score_document(services.engine.program(), about(record), metrics, judge));
}

/// By a rubric that nobody has saved yet; nothing is kept.
net::Response preview_score(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  const session::SessionRecord record = services.sessions.get(id);
  const session::Judge judge{requested_rubric(body_of(request)), "", nullptr, false};
  const json document =
      session::score_document(services.engine.program(), about(record), services.sessions.metrics(id), judge);
  return score_response(id, is_live(record.status.state) ? "live" : "computed", document);
}

net::Response score_anew(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  const session::SessionRecord record = services.sessions.get(id);
  require_ended(record, "its score can be kept when it has ended");
  const fs::path folder = services.sessions.folder_of(id);
  const json metrics = services.sessions.metrics(id);
  const session::Judge judge =
      services.stores.judge_by(text_in(body_of(request), "rubric"), text_in(body_of(request), "benchmark"));
  const FileLock lock = lock_of_ended(folder);
  const json document = session::score_document(services.engine.program(), about(record), metrics, judge);
  session::write_results(folder, metrics, document);
  services.sessions.note_results(id);
  return score_response(id, "kept", document);
}

/// Those with metrics, of all that the caller may see.
std::vector<session::EndedSession> table_sessions(const Services& services, const net::Request& request) {
  store::SessionQuery query = session_query(request);
  query.limit = SIZE_MAX;
  std::vector<session::EndedSession> sessions;
  for (const session::SessionRecord& record : sessions_for(services, request.caller, query).sessions) {
    if (is_live(record.status.state) || services.feel.hides(request.caller, record.request)) continue;
    const fs::path folder = services.sessions.folder_of(record.request.id);
    std::error_code failed;
    if (!fs::exists(session::metrics_json(folder), failed)) continue;
    sessions.push_back({record.request.id, read_json_file(session::session_json(folder)),
                        read_json_file(session::metrics_json(folder))});
  }
  return sessions;
}

net::Response list_scores(const Services& services, const net::Request& request) {
  const session::Judge judge = services.stores.judge_by(query_text(request, "rubric"));
  session::ExportTable table, codebook;
  services.executor.run([&] {
    table = session::score_table(table_sessions(services, request), judge.rubric);
    codebook = session::score_codebook(table);
  });
  table.name = "scores";
  if (query_text(request, "format") == "csv")
    return query_text(request, "table") == "codebook" ? csv_response(codebook, codebook.name + ".csv")
                                                      : csv_response(table, table.name + ".csv");
  return net::json_response(200, {{"rubric", {{"id", judge.rubric_id}, {"version", judge.rubric.version}}},
                                  {"scores", session::json_of(table)},
                                  {"codebook", session::json_of(codebook)}});
}

}  // namespace

std::vector<Route> score_routes() {
  const std::string score = "/api/v1/sessions/{id}/score";
  return {{"GET", score, access::all_roles, reads("session.score.read"), get_score},
          {"POST", score, access::staff, changes("session.score"), score_anew, {"session", "scored"}},
          {"POST", score + "/preview", access::staff, reads("session.score.read"), preview_score},
          {"GET", "/api/v1/scores", access::reamers, reads("scores.read"), list_scores}};
}

}  // namespace ream::api
