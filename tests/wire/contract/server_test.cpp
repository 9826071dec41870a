#include <future>
#include <thread>

#include "core/utc.hpp"
#include "server_fixture.hpp"
#include "support/expect_error.hpp"

namespace ream::test {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;
const std::string sessions = "/api/v1/sessions";

TEST_F(ServerTest, ListsReadableCasesAndTellsOneWhole) {
  start();
  const json list = json::parse(get("/api/v1/cases").body).at("cases");
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0], (json{{"id", "planned"},
                           {"name", "A slab"},
                           {"side", "right"},
                           {"stage", "built"},
                           {"dims", {8, 8, 8}},
                           {"spacing_mm", {0.5, 0.5, 0.5}},
                           {"planned", true}}));
  EXPECT_EQ(list[1].at("side"), "left");
  const json whole = json::parse(get("/api/v1/cases/planned").body);
  EXPECT_EQ(whole.at("plan").at("depth_mm"), 2.0);
  EXPECT_EQ(whole.at("plan").at("pilot_diameter_mm"), 6.2);
  EXPECT_EQ(whole.at("warnings"), json{"one slice is missing"});
  EXPECT_EQ(json::parse(get("/api/v1/cases/unplanned").body).at("plan"), nullptr);
}

TEST_F(ServerTest, CaseIdsAreNoPaths) {
  start();
  for (const char* id : {"..", "%2e%2e", "..%2f..", "planned%00", "Planned", "planned/", "."})
    EXPECT_GE(get(std::string("/api/v1/cases/") + id).status, 400) << id;
}

TEST_F(ServerTest, NoFolderOfCasesIsAnEmptyList) {
  options.cases_folder = folder.path() / "nowhere";
  start();
  EXPECT_EQ(json::parse(get("/api/v1/cases").body).at("cases"), json::array());
}

TEST_F(ServerTest, CreatesStartsAndStops) {
  start();
  const HttpReply reply = post(sessions, R"({"case": "planned", "script": "demo", "force_scale": 13})");
  ASSERT_EQ(reply.status, 201);
  const json session = json::parse(reply.body);
  EXPECT_EQ(reply.headers.at("location"), sessions + "/" + session.at("id").get<std::string>());
  EXPECT_EQ(session.at("state"), "created");
  EXPECT_EQ(session.at("force_scale"), 13.0);
  EXPECT_EQ(session.at("fault"), nullptr);
  const std::string path = reply.headers.at("location");
  EXPECT_EQ(json::parse(post(path + "/start").body).at("state"), "running");
  EXPECT_EQ(json::parse(get(path + "/metrics").body).at("grid_hash"), nullptr);
  EXPECT_EQ(json::parse(post(path + "/stop").body).at("state"), "stopped");
  EXPECT_EQ(json::parse(get(path + "/metrics").body).at("grid_hash"), "00112233445566ff");
}

TEST_F(ServerTest, ListsSessionsNewestFirst) {
  start();
  std::vector<std::string> made, listed;
  for (size_t i = 0; i < options.sessions.live; ++i) made.insert(made.begin(), create());
  const json list = json::parse(get(sessions).body);
  for (const json& session : list.at("sessions")) listed.push_back(session.at("id"));
  EXPECT_EQ(listed, made);
}

TEST_F(ServerTest, ListsAreFilteredAndGoOnPageByPage) {
  start();
  for (int i = 0; i < 7; ++i)
    folder.write("sessions/old" + std::to_string(i) + "/session.json",
                 json{{"case", i % 2 == 0 ? "planned" : "other"},
                      {"script", "demo"},
                      {"state", i < 5 ? "finished" : "stopped"},
                      {"trainee", "Anna"},
                      {"trainee_id", i < 3 ? "anna" : "ben"},
                      {"created_utc", "2026-01-0" + std::to_string(i + 1) + "T12:00:00Z"}}
                     .dump());
  const auto ids = [&](const std::string& query) {
    std::string found;
    const json page = json::parse(get(sessions + "?" + query).body);
    for (const json& session : page.at("sessions")) found += session.at("id").get<std::string>().substr(3);
    return found;
  };
  EXPECT_EQ(ids(""), "6543210");
  EXPECT_EQ(ids("sort=created_utc"), "0123456");
  EXPECT_EQ(ids("state=stopped"), "65");
  EXPECT_EQ(ids("state=stopped,running"), "65");
  EXPECT_EQ(ids("case=planned&trainee=ben"), "64");
  EXPECT_EQ(ids("from=2026-01-03&to=2026-01-05T12:00:00Z"), "32");
  EXPECT_EQ(ids("q=anna%20other"), "531");

  std::string found, target = sessions + "?limit=3&sort=-created_utc&case=planned";
  for (int pages = 0; pages < 2; ++pages) {
    const HttpReply reply = get(target);
    const json page = json::parse(reply.body);
    EXPECT_EQ(page.at("total"), 4);
    for (const json& session : page.at("sessions")) found += session.at("id").get<std::string>().substr(3);
    ASSERT_EQ(page.at("next").is_null(), pages == 1);
    ASSERT_EQ(reply.headers.contains("link"), pages == 0);
    if (pages == 1) break;
    const std::string link = reply.headers.at("link");
    ASSERT_TRUE(link.starts_with("<" + sessions + "?") && link.ends_with(">; rel=\"next\"")) << link;
    target = link.substr(1, link.find('>') - 1);
  }
  EXPECT_EQ(found, "6420");
}

TEST_F(ServerTest, CasesGoOnPageByPageToo) {
  start();
  std::vector<std::string> found;
  std::string cursor;
  for (;;) {
    const json page = json::parse(get("/api/v1/cases?limit=1&sort=-id" + cursor).body);
    ASSERT_EQ(page.at("cases").size(), 1u);
    EXPECT_EQ(page.at("total"), 2);
    found.push_back(page.at("cases").at(0).at("id"));
    if (page.at("next").is_null()) break;
    cursor = "&cursor=" + page.at("next").get<std::string>();
  }
  EXPECT_EQ(found, (std::vector<std::string>{"unplanned", "planned"}));
  EXPECT_EQ(get("/api/v1/cases?sort=id" + cursor).status, 422) << "a cursor belongs to its order";
}

TEST_F(ServerTest, BadBodiesAreExplainedAndMakeNothing) {
  start();
  const json problem = json::parse(post(sessions, R"({"case": 1, "script": "..", "scrpt": "demo"})").body);
  EXPECT_EQ(problem.at("status"), 422);
  EXPECT_EQ(problem.at("errors").size(), 3u) << problem;
  EXPECT_NE(problem.at("detail").get<std::string>().find("'scrpt' is not a known key"), std::string::npos);
  EXPECT_EQ(post(sessions, R"({"case": "demo")").status, 400);
  EXPECT_EQ(json::parse(get(sessions).body).at("sessions"), json::array());
}

TEST_F(ServerTest, FullServerSaysSoAndWhatToDo) {
  options.sessions.live = 1;
  start();
  const std::string id = create();
  const HttpReply refused = post(sessions, R"({"case": "planned", "script": "demo"})");
  EXPECT_EQ(refused.status, 503);
  EXPECT_NE(refused.body.find("stop one first"), std::string::npos);
  EXPECT_EQ(post(sessions + "/" + id + "/stop").status, 200);
  create();
}

TEST_F(ServerTest, StreamsToSeveralViewers) {
  start();
  const std::string id = create();
  RawWebSocket one(server->port(), sessions + "/" + id + "/stream");
  RawWebSocket two(server->port(), sessions + "/" + id + "/stream");
  EXPECT_EQ(one.receive().payload, "hello " + id);
  EXPECT_EQ(two.receive().payload, "hello " + id);
  one.send_binary("ping");
  EXPECT_EQ(one.receive().payload, "ping");
}

TEST_F(ServerTest, PageIsServedAndUnknownApiPathsAreProblems) {
  start();
  EXPECT_EQ(get("/").body, "<html>page</html>");
  EXPECT_EQ(get("/../cases/planned/case.json").status, 404);
  const HttpReply unknown = get("/api/v1/unknown");
  EXPECT_EQ(unknown.status, 404);
  EXPECT_EQ(unknown.headers.at("content-type"), "application/problem+json");
  EXPECT_NE(unknown.body.find("no such endpoint: /api/v1/unknown"), std::string::npos) << unknown.body;
  EXPECT_EQ(http_request(server->port(), "DELETE", sessions).status, 405);
}

TEST_F(ServerTest, StopsWhileViewersWatchAndSessionsRun) {
  start();
  const std::string id = create();
  post(sessions + "/" + id + "/start");
  RawWebSocket viewer(server->port(), sessions + "/" + id + "/stream");
  viewer.receive();
  RawSocket idle(server->port());
  const int stops = FakeSession::stops();
  std::thread stopping([this] { server->stop(); });
  EXPECT_EQ(viewer.receive().close_code(), 1001);
  viewer.send_close(1001);
  viewer.socket().end_sending();
  stopping.join();
  EXPECT_EQ(FakeSession::stops(), stops + 1);
  EXPECT_EQ(idle.receive_all(), "");
}

TEST_F(ServerTest, NothingListensAfterItsStop) {
  start();
  EXPECT_EQ(get("/healthz").status, 200);
  server->stop();
  EXPECT_THROW(RawSocket{server->port()}, std::runtime_error);
}

TEST_F(ServerTest, PortInUseLeavesNothingBehind) {
  start();
  api::ServerOptions second = options;
  second.listen.port = server->port();
  expect_error(ErrorKind::unavailable, "is in use; choose another with --port",
               [&] { api::Server refused(second); });
  EXPECT_EQ(get("/healthz").status, 200);
}

}  // namespace
}  // namespace ream::test
