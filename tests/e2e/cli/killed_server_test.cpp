#include <signal.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <optional>
#include <random>
#include <thread>

#include "e2e/cli/serve_block_fixture.hpp"
#include "record/recording.hpp"
#include "support/full_tests.hpp"
#include "support/places.hpp"
#include "support/seed.hpp"

namespace ream::test {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

constexpr double longest_loss_s = 1.0;

class KilledServer : public ServeBlock {
 protected:
  /// `before`: words of a shell that are run in the server's process first.
  void serve(const std::string& before = {}) {
    const std::string program = build_folder() + "/ream";
    server_ = start_program(
        {"/bin/sh", "-c",
         before + " exec " + program + " serve --port 0 --web web --backend cpu --realtime off --json"},
        "server");
    hear_where_it_is();
    until_ready();
  }

  std::filesystem::path folder_of(const std::string& id) const { return folder() / "data/sessions" / id; }

  /// Asks for metrics, far below what one address may ask, until the server is dead; the last duration it
  /// told, if it ever started the session.
  std::optional<double> watch_until_killed(const std::string& id, std::chrono::milliseconds life) {
    std::thread killer([this, life] {
      std::this_thread::sleep_for(life);
      server_->send_signal(SIGKILL);
    });
    std::optional<double> seen;
    try {
      if (http_request(port_, "POST", path_of(id) + "/start").status == 200) seen = 0.0;
      for (bool answered = true; answered; std::this_thread::sleep_for(2ms)) {
        const HttpReply reply = http_request(port_, "GET", path_of(id) + "/metrics");
        answered = reply.status == 200;
        EXPECT_TRUE(answered) << reply.status << ' ' << reply.body;
        if (answered)
          seen = std::max(seen.value_or(0.0), json::parse(reply.body).at("duration_s").get<double>());
      }
    } catch (const std::exception&) {  // it is dead
    }
    killer.join();
    EXPECT_EQ(server_->wait(10s), 128 + SIGKILL);
    return seen;
  }

  /// Starts the session and kills the server once it has run for so long; what it told last.
  double kill_after(const std::string& id, double time_s) {
    request(200, "POST", path_of(id) + "/start");
    double seen_s = 0.0;
    until("it has run for a while", [&] { return (seen_s = duration_s(id)) > time_s; });
    server_->send_signal(SIGKILL);
    EXPECT_EQ(server_->wait(10s), 128 + SIGKILL);
    return seen_s;
  }

  void expect_recovered(const std::string& id, std::optional<double> seen_s) {
    const HttpReply reply = http_request(port_, "GET", path_of(id));
    if (reply.status == 404) {
      EXPECT_FALSE(seen_s) << "a session that ran is not listed";
      return;
    }
    const json session = json::parse(reply.body);
    EXPECT_EQ(session.at("state"), "interrupted");
    const record::Recording recording(folder_of(id) / "recording.ream", record::Recording::Trust::checked);
    EXPECT_EQ(recording.log().damage(), "");
    EXPECT_EQ(recording.end().value().state, "interrupted");
    const double kept_s = session.at("duration_s").get<double>();
    EXPECT_DOUBLE_EQ(kept_s, recording.tick_count() * 1e-3);
    EXPECT_GE(kept_s, seen_s.value_or(0.0) - longest_loss_s);
    worst_loss_s_ = std::max(worst_loss_s_, seen_s.value_or(0.0) - kept_s);
    EXPECT_DOUBLE_EQ(duration_s(id), kept_s);
    const std::string said = printed("server.err");
    const auto first = said.find("session " + id);
    EXPECT_NE(first, std::string::npos) << said;
    EXPECT_EQ(said.find("session " + id, first + 1), std::string::npos) << "said more than once\n" << said;
  }

  void expect_nothing_half_written() {
    for (const std::string& entry : tree()) EXPECT_EQ(entry.find(".tmp"), std::string::npos) << entry;
  }

  double worst_loss_s_ = 0.0;
};

TEST_F(KilledServer, LosesLessThanASecondAtAnyMoment) {
  const char* wanted = std::getenv("REAM_KILLS");
  const int kills = wanted ? std::atoi(wanted) : tried_of(200, 8);
  std::cout << kills << " kills (REAM_KILLS)\n";
  std::mt19937 random(test::seed());
  std::uniform_int_distribution<int> life_ms(0, 2500);
  int recorded = 0;
  std::optional<std::string> id;
  std::optional<double> seen_s;
  for (int kill = 0; kill <= kills; ++kill) {
    serve();
    if (id) expect_recovered(*id, seen_s);
    expect_nothing_half_written();
    if (id && kill % 5 == 0 && seen_s.value_or(0.0) > longest_loss_s) {
      succeed({"replay", *id, "--verify"});
      ++recorded;
    }
    if (kill == kills) break;
    id = create();
    seen_s = watch_until_killed(*id, std::chrono::milliseconds(life_ms(random)));
    if (HasFailure()) FAIL() << "kill " << kill << '\n' << printed("server.err");
  }
  std::cout << "longest time lost " << worst_loss_s_ << " s; " << recorded << " recordings proven\n";
}

TEST_F(KilledServer, AnInterruptedSessionGoesOnAndIsExact) {
  serve();
  const std::string id = create();
  const double seen_s = kill_after(id, 1.0);
  serve();
  expect_recovered(id, seen_s);
  const json before = request(200, "GET", path_of(id) + "/metrics");
  const json resumed = request(200, "POST", path_of(id) + "/resume", R"({"reamer": "sphere 14,8"})");
  EXPECT_EQ(resumed.at("id"), id);
  EXPECT_EQ(resumed.at("state"), "running");
  request(409, "POST", path_of(id) + "/resume");
  EXPECT_EQ(answer({"list", "sessions"}).at(0).at("state"), "running");
  request(201, "POST", path_of(id) + "/annotations", R"({"words": "goes on here", "author": "anna"})");
  const double first_s = before.at("duration_s");
  until("it has gone on for a second", [&] { return duration_s(id) > first_s + 1.0; });
  EXPECT_EQ(request(200, "POST", path_of(id) + "/stop").at("state"), "stopped");
  request(201, "POST", path_of(id) + "/annotations", R"({"words": "after the end"})");
  EXPECT_EQ(request(200, "GET", path_of(id) + "/annotations").at("annotations").size(), 2u);
  const json after = request(200, "GET", path_of(id) + "/metrics");
  EXPECT_GE(after.at("removed_volume_mm3"), before.at("removed_volume_mm3"));
  const record::Recording recording(folder_of(id) / "recording.ream", record::Recording::Trust::checked);
  ASSERT_EQ(recording.segments().size(), 2u);
  EXPECT_EQ(recording.segments()[1].reason, "reamer");
  EXPECT_EQ(recording.segments()[1].tool, "sphere 14,8");
  EXPECT_DOUBLE_EQ(recording.tick_count() * 1e-3, after.at("duration_s").get<double>());
  succeed({"replay", id, "--verify"});
  request(409, "POST", path_of(create()) + "/resume");
  request(200, "POST", path_of(id) + "/resume");
  request(200, "POST", path_of(id) + "/stop");
  succeed({"replay", id, "--verify"});
}

TEST_F(KilledServer, AFullDiskEndsTheSessionNotTheServer) {
  serve();  // makes what is always there
  server_->send_signal(SIGTERM);
  ASSERT_EQ(server_->wait(20s), 0);
  serve("ulimit -f 64;");  // files of 32 KiB at most
  const std::string id = create();
  request(200, "POST", path_of(id) + "/start");
  until("the session has ended",
        [&] { return request(200, "GET", path_of(id)).at("state").get<std::string>() != "running"; });
  const json session = request(200, "GET", path_of(id));
  EXPECT_EQ(session.at("state"), "fault");
  EXPECT_NE(session.at("fault").get<std::string>().find("recording.ream"), std::string::npos) << session;
  const json metrics = request(200, "GET", path_of(id) + "/metrics");
  request(200, "GET", "/healthz");
  server_->send_signal(SIGTERM);
  EXPECT_EQ(server_->wait(20s), 0) << printed("server.err");
  serve();
  const json later = request(200, "GET", path_of(id));
  EXPECT_TRUE(later.at("state") == "fault" || later.at("state") == "interrupted") << later;
  const record::Recording recording(folder_of(id) / "recording.ream", record::Recording::Trust::checked);
  EXPECT_EQ(recording.log().damage(), "");
  EXPECT_GT(recording.tick_count(), 0u);
  EXPECT_DOUBLE_EQ(duration_s(id), recording.tick_count() * 1e-3);
  expect_nothing_half_written();
  const std::string next = create();
  request(200, "POST", path_of(next) + "/start");
  request(200, "POST", path_of(next) + "/stop");
}

TEST_F(KilledServer, ASecondServerIsRefusedBeforeItRecoversWhatStillRuns) {
  serve();
  const std::string id = create();
  request(200, "POST", path_of(id) + "/start");
  refuse_beside_others(1, "a server runs on " + (folder() / "data").string(),
                       {"serve", "--port", "0", "--web", "web"});
  EXPECT_EQ(request(200, "GET", path_of(id)).at("state"), "running");
  EXPECT_EQ(request(200, "POST", path_of(id) + "/stop").at("state"), "stopped");
}

}  // namespace
}  // namespace ream::test
