// PostgreSQL is stopped and started again while requests come in and a session reams.
#include <gtest/gtest.h>

#include <atomic>
#include <set>

#include "record/recording.hpp"
#include "store/database.hpp"
#include "support/database_hog.hpp"
#include "support/live_server.hpp"
#include "support/postgres_server.hpp"

namespace ream::test {
namespace {

using nlohmann::json;

/// Somebody who lists, looks, makes sessions and ends them, without a pause, and remembers what was answered.
class Visitor {
 public:
  Visitor(const std::string& name, uint16_t port, const std::string& watched)
      : name_(name), port_(port), watched_(watched), thread_([this] { visit(); }) {}
  ~Visitor() { leave(); }
  Visitor(const Visitor&) = delete;
  Visitor& operator=(const Visitor&) = delete;

  void leave() {
    leaving_ = true;
    if (thread_.joinable()) thread_.join();
  }

  /// Rounds in which every request went well, and requests that did not.
  std::atomic<int> good_rounds{0}, refusals{0};
  // After leave():
  std::set<std::string> made;  ///< sessions of which the server has said that they are there
  std::set<std::pair<int, std::string>> complaints;
  std::vector<std::string> failures;  ///< anything but a reply

 private:
  /// Whether it was answered as wished.
  bool ask(const std::string& method, const std::string& path, const std::string& body, json& answer) {
    std::map<std::string, std::string> headers;
    if (method == "POST") headers["Idempotency-Key"] = name_ + "-" + std::to_string(++asked_);
    const HttpReply reply = http_request(port_, method, "/api/v1/sessions" + path, body, headers);
    answer = json::parse(reply.body);
    if (reply.status < 300) return true;
    complaints.emplace(reply.status, answer.value("detail", reply.body));
    ++refusals;
    return false;
  }

  void visit() {
    while (!leaving_) try {
        json answer;
        bool good = ask("GET", "?limit=5", "", answer);
        good = ask("GET", "/" + watched_, "", answer) && good;
        if (ask("POST", "", R"({"case": "slab", "script": "long"})", answer)) {
          const std::string id = answer.at("id");
          made.insert(id);
          // What was refused meanwhile is tried until it is done: the places for live sessions are few.
          while (!ask("POST", "/" + id + "/stop", "", answer)) {
            good = false;
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
          }
        } else {
          good = false;
        }
        if (good) ++good_rounds;
      } catch (const std::exception& failure) {
        failures.emplace_back(failure.what());
      }
  }

  const std::string name_;
  const uint16_t port_;
  const std::string watched_;
  int asked_ = 0;
  std::atomic<bool> leaving_{false};
  std::thread thread_;
};

/// Of all pages of the list.
std::set<std::string> listed(uint16_t port) {
  std::set<std::string> ids;
  std::string cursor;
  do {
    const json page = json::parse(http_request(port, "GET", "/api/v1/sessions?limit=50" + cursor).body);
    for (const json& session : page.at("sessions")) ids.insert(session.at("id").get<std::string>());
    cursor = page.at("next").is_null() ? "" : "&cursor=" + page.at("next").get<std::string>();
  } while (!cursor.empty());
  return ids;
}

uint64_t recorded_bytes(const LiveServer& server, const std::string& id) {
  return std::filesystem::file_size(server.folder(id) / "recording.ream");
}

TEST(Outage, NothingIsLostAndTheSessionNeverNotices) {
  PostgresServer postgres;
  const std::string url = postgres.make_database();
  const auto database = std::make_shared<store::Database>(url);
  const LiveServer server([&](api::ServerOptions& options) {
    options.database = database;
    options.listen.limits.requests_per_address = {100'000.0, 100'000.0};  // visitors do not pause
    options.listen.limits.requests_per_caller = {100'000.0, 100'000.0};
    options.sessions.kept = 10'000;  // what was never started stands in no folder
  });
  write_file_atomically(server.reaming().data() / "scripts/long.json",
                        RecordedReaming::push("ideal", 600.0).dump());
  const std::string id = server.run({{"case", "slab"}, {"script", "long"}});
  {
    Visitor first("first-visitor", server.port(), id), second("second-visitor", server.port(), id);
    LiveServer::until("visitors to be served",
                      [&] { return first.good_rounds > 2 && second.good_rounds > 2; });
    postgres.stop();
    const uint64_t when_it_stopped = recorded_bytes(server, id);
    LiveServer::until("visitors to be refused", [&] { return first.refusals > 20 && second.refusals > 20; });
    LiveServer::until("the session to go on", [&] { return recorded_bytes(server, id) > when_it_stopped; });
    LiveServer::until("the server to say that its database is away", [&] {
      const HttpReply reply = http_request(server.port(), "GET", "/readyz");
      return reply.status == 503 && reply.body.find("the database does not answer") != std::string::npos;
    });
    EXPECT_EQ(http_request(server.port(), "GET", "/healthz").status, 200);
    postgres.start();
    LiveServer::until("the server to be ready again",
                      [&] { return http_request(server.port(), "GET", "/readyz").status == 200; });
    const int before[] = {first.good_rounds, second.good_rounds};
    LiveServer::until("visitors to be served again", [&] {
      return first.good_rounds > before[0] + 2 && second.good_rounds > before[1] + 2;
    });
    first.leave();
    second.leave();
    std::set<std::string> made = first.made;
    made.insert(second.made.begin(), second.made.end());
    EXPECT_GT(made.size(), 8u);
    const std::set<std::string> found = listed(server.port());
    for (const std::string& session : made) EXPECT_TRUE(found.contains(session)) << session << " is lost";
    for (const Visitor* visitor : {&first, &second}) {
      EXPECT_EQ(visitor->failures, std::vector<std::string>{});
      for (const auto& [status, detail] : visitor->complaints) {
        EXPECT_EQ(status, 503) << detail;
        EXPECT_NE(detail.find("the database at " + database->name()), std::string::npos) << detail;
        EXPECT_EQ(detail.find("ream@"), std::string::npos) << detail;
      }
    }
  }
  EXPECT_EQ(server.get(id).at("state"), "running");
  EXPECT_TRUE(server.get(id).at("fault").is_null());
  server.post("/" + id + "/stop");
  EXPECT_FALSE(server.reaming().verify(server.folder(id) / "recording.ream").difference);
}

TEST(Outage, ASessionCanBePausedWhileEveryUsualWorkerWaits) {
  const TemporaryFolder folder;
  const auto database = std::make_shared<store::Database>(
      "sqlite:" + (folder.path() / "ream.db").string(),
      store::DatabaseLimits{.connections = 1, .timeout = std::chrono::minutes(2)});
  const LiveServer server([&](api::ServerOptions& options) { options.database = database; });
  write_file_atomically(server.reaming().data() / "scripts/long.json",
                        RecordedReaming::push("ideal", 600.0).dump());
  const std::string id = server.run({{"case", "slab"}, {"script", "long"}});
  std::vector<std::unique_ptr<RawSocket>> waiting;
  {
    const DatabaseHog hog(*database);
    for (int i = 0; i < 20; ++i) {
      waiting.push_back(std::make_unique<RawSocket>(server.port()));
      waiting.back()->send("GET /api/v1/sessions?limit=5 HTTP/1.1\r\nHost: localhost\r\n\r\n");
    }
    EXPECT_EQ(http_request(server.port(), "GET", "/healthz").status, 200);
    EXPECT_EQ(server.post("/" + id + "/pause").at("state"), "paused");
  }
  // They waited for the hog, or they could not have been answered.
  for (const auto& socket : waiting) EXPECT_EQ(receive_reply(*socket).status, 200);
}

}  // namespace
}  // namespace ream::test
