#pragma once
#include <thread>

#include "contract_fixture.hpp"
#include "core/file.hpp"
#include "score/rubric_store.hpp"
#include "support/some_metrics.hpp"

namespace ream::test {

/// A server with sessions that have ended in its data folder, whose recordings say what their metrics said,
/// and twice the time.
class ScoreTest : public ContractTest {
 protected:
  ScoreTest() { options.data_folder = folder.path(); }
  ~ScoreTest() override { release(); }

  /// `size`: of what its metrics say; created on that day of January.
  void put_session(const std::string& id, double size, int day, const json& more = json::object()) {
    const std::string date = (day < 10 ? "0" : "") + std::to_string(day);
    json session = {{"case", "planned"},
                    {"script", "demo"},
                    {"device", "browser"},
                    {"state", "stopped"},
                    {"created_utc", "2026-01-" + date + "T12:00:00.000Z"},
                    {"ticks", 5000},
                    {"trainee_id", "tina"}};
    session.merge_patch(more);
    folder.write("sessions/" + id + "/session.json", session.dump());
    folder.write("sessions/" + id + "/metrics.json", some_metrics(size).dump());
    folder.write("sessions/" + id + "/recording.ream", "0123456789");
  }
  json kept(const std::string& id, const std::string& file) {
    return read_json_file(folder.path() / "sessions" / id / file);
  }
  void hold() { engine->held = true; }
  void release() { engine->held = false; }

  json told(const std::string& path) {
    const HttpReply reply = get(path);
    EXPECT_EQ(reply.status, 200) << path << ": " << reply.body;
    return json::parse(reply.body);
  }
  json job(const std::string& id) { return told("/api/v1/jobs/" + id); }
  json ended(const HttpReply& reply) {
    json now = json::parse(reply.body);
    while (now.at("state") == "waiting" || now.at("state") == "running") {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      now = job(now.at("id"));
    }
    return now;
  }
  HttpReply put(const std::string& path, const std::string& body, const std::string& if_match = {}) {
    std::map<std::string, std::string> headers;
    if (!if_match.empty()) headers["If-Match"] = if_match;
    return http_request(server->port(), "PUT", path, body, headers);
  }

  /// Judges by version_error_deg alone: 100 points at 0 degrees, none at 10, passed from 50 on.
  static json simple_rubric(int version) {
    return {{"name", "Simple"},
            {"version", version},
            {"pass_points", 50},
            {"criteria", {{{"metric", "version_error_deg"}, {"none", 10}, {"full", 0}}}}};
  }
  void add_simple_rubric() {
    const json wanted = {{"id", "simple"}, {"rubric", simple_rubric(1)}};
    EXPECT_EQ(post(rubrics, wanted.dump()).status, 201);
  }

  const std::string rubrics = "/api/v1/rubrics", one_rubric = rubrics + "/{id}",
                    benchmarks = "/api/v1/benchmarks", one_benchmark = benchmarks + "/{id}",
                    learning = "/api/v1/learning", scores = "/api/v1/scores",
                    rescorings = "/api/v1/rescorings", one_job = "/api/v1/jobs/{id}";
};

}  // namespace ream::test
