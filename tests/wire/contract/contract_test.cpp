#include <future>

#include "api/routes.hpp"
#include "contract_fixture.hpp"
#include "support/places.hpp"

namespace ream::test {
namespace {

class ServerContractTest : public ContractTest {
 protected:
  void creation() {
    const std::string good = R"({"case": "planned", "script": "demo"})";
    expect_post(all, all, 201, good);
    const json made = json::parse(expect_repeatable(all, all, 201, good).body);
    expect_post(one + "/stop", all + "/" + made.at("id").get<std::string>() + "/stop", 200);
    expect_post(all, all, 400, "{");
    expect_post(all, all, 403, good, foreign);
    expect_post(all, all, 404, R"({"case": "missing", "script": "demo"})");
    expect_post(all, all, 409, R"({"case": "unplanned", "script": "demo"})");
    expect_post(all, all, 413, std::string(options.listen.limits.body_bytes + 1, ' '));
    expect_post(all, all, 415, good, {{"Content-Type", "text/plain"}});
    expect_post(all, all, 422, R"({"case": "planned", "scrpt": "demo"})");
    expect_get(all, all, 200);
  }

  void life_of_a_session() {
    const std::string id = create(), path = all + "/" + id;
    expect_get(one, path, 200);
    expect_get(one, all + "/nobody", 404);
    expect_get(one + "/metrics", path + "/metrics", 200);
    expect_get(one + "/metrics", all + "/nobody/metrics", 404);
    expect_post(one + "/start", path + "/start", 403, "", foreign);
    expect_post(one + "/start", path + "/start", 200);
    expect_post(one + "/start", path + "/start", 409);
    expect_post(one + "/start", all + "/nobody/start", 404);
    pausing(path);
    expect_post(one + "/stop", path + "/stop", 403, "", foreign);
    expect_post(one + "/stop", path + "/stop", 200);
    expect_post(one + "/stop", path + "/stop", 409);
    expect_post(one + "/stop", all + "/nobody/stop", 404);
    expect_get(one + "/metrics", path + "/metrics", 200);
    resume(path);
    annotations(path);
    changing(path);
    resetting();
    const std::string stuck = create("no-start");
    expect_post(one + "/start", all + "/" + stuck + "/start", 503);
    engine->made(6).set(SessionState::fault, "the device fell silent");
    expect_get(one, all + "/" + stuck, 200);
    expect_stream(path + "/stream", 101);
    expect_stream(path + "/stream?stride=4", 101);
    expect_stream(path + "/stream?stride=3", 422);
    expect_stream(path + "/stream", 403, foreign);
    expect_stream(all + "/nobody/stream", 404);
    expect_stream(all + "/earlier/stream", 409);
    expect_get(one + "/stream", path + "/stream", 426);
    device(path);
    replays_of(id);
  }

  void pausing(const std::string& path) {
    const std::string pattern = one + "/pause";
    expect_post(pattern, path + "/pause", 403, "", foreign);
    expect_post(pattern, all + "/nobody/pause", 404);
    expect_post(pattern, path + "/pause", 200);
    EXPECT_EQ(json::parse(get(path).body).at("held"), true);
    expect_post(pattern, path + "/pause", 409);
    expect_post(one + "/start", path + "/start", 200);
    EXPECT_EQ(json::parse(get(path).body).at("state"), "running");
  }

  void changing(const std::string& path) {
    const std::string good =
        R"({"title": "first try", "keep": true, "trainee": "Anna", "trainee_id": "anna"})";
    expect_request("PATCH", one, path, 200, good);
    expect_request("PATCH", one, path, 400, "{");
    expect_request("PATCH", one, path, 403, good, foreign);
    expect_request("PATCH", one, all + "/nobody", 404, good);
    expect_request("PATCH", one, path, 413, std::string(options.listen.limits.body_bytes + 1, ' '));
    expect_request("PATCH", one, path, 415, good, {{"Content-Type", "text/plain"}});
    expect_request("PATCH", one, path, 422, R"({"titel": "first try"})");
    const auto lock = FileLock::attempt(session::lock_file(options.sessions_folder / "earlier"));
    expect_request("PATCH", one, all + "/earlier", 409, good);
    EXPECT_EQ(json::parse(get(path).body).at("title"), "first try");
  }

  void resetting() {
    const std::string pattern = one + "/reset", first = all + "/" + create();
    expect_post(pattern, first + "/reset", 403, "", foreign);
    expect_post(pattern, all + "/nobody/reset", 404);
    expect_post(one + "/start", first + "/start", 200);
    const HttpReply reply = expect_repeatable(pattern, first + "/reset", 201);
    const json next = json::parse(reply.body), old = json::parse(get(first).body);
    EXPECT_EQ(next.at("reset_of"), old.at("id"));
    EXPECT_EQ(next.at("attempt"), 2);
    EXPECT_EQ(next.at("state"), "running");
    EXPECT_EQ(old.at("followed_by"), next.at("id"));
    EXPECT_EQ(old.at("state"), "stopped");
    expect_post(pattern, first + "/reset", 409);
    expect_post(one + "/stop", all + "/" + next.at("id").get<std::string>() + "/stop", 200);
  }

  void expect_device(const std::string& path, int status,
                     const std::map<std::string, std::string>& headers = {}) {
    const RawWebSocket client(server->port(), path, headers);
    expect_as_described("GET", one + "/device", status, client.handshake());
  }

  void device(const std::string& scripted) {
    const json made = json::parse(post(all, R"({"case": "planned", "device": "network"})").body);
    EXPECT_EQ(made.at("script"), "practice");
    const std::string path = all + "/" + made.at("id").get<std::string>();
    expect_device(path + "/device", 101);
    expect_device(path + "/device", 403, foreign);
    expect_device(all + "/nobody/device", 404);
    expect_device(scripted + "/device", 409);
    expect_get(one + "/device", path + "/device", 426);
    expect_post(one + "/stop", path + "/stop", 200);
  }

  void replays_of(const std::string& ended) {
    const std::string path = all + "/" + ended + "/replay", live = all + "/" + create();
    expect_post(one + "/replay", path, 403, "", foreign);
    expect_post(one + "/replay", all + "/nobody/replay", 404);
    expect_post(one + "/replay", live + "/replay", 409);
    engine->refuse_replay = [] { throw Error(ErrorKind::invalid_input, "recording.ream is damaged"); };
    expect_post(one + "/replay", path, 422);
    engine->refuse_replay = [] {};
    expect_repeatable(one + "/replay", path, 201);
    const std::string id = json::parse(get(all).body).at("replays").at(0).at("id"), open = all + "/" + id;
    expect_get(all, all, 200);
    expect_get(one, open, 200);
    expect_get(one + "/metrics", open + "/metrics", 200);
    engine->made_replay(0).refuse_metrics(ErrorKind::unavailable);
    expect_get(one + "/metrics", open + "/metrics", 503);
    engine->made_replay(0).refuse_metrics(ErrorKind::invalid_input);
    expect_get(one + "/metrics", open + "/metrics", 422);
    expect_stream(open + "/stream", 101);
    expect_post(one + "/playback", open + "/playback", 200,
                R"({"playing": true, "speed": 4, "position_s": 2.5})");
    expect_post(one + "/playback", open + "/playback", 400, "{");
    expect_post(one + "/playback", open + "/playback", 403, "{}", foreign);
    expect_post(one + "/playback", all + "/nobody/playback", 404, "{}");
    expect_post(one + "/playback", live + "/playback", 404, "{}");
    expect_post(one + "/playback", open + "/playback", 413,
                std::string(options.listen.limits.body_bytes + 1, ' '));
    expect_post(one + "/playback", open + "/playback", 415, "{}", {{"Content-Type", "text/plain"}});
    expect_post(one + "/playback", open + "/playback", 422, R"({"position_s": 11})");
    for (size_t i = 0; i < options.replays.open; ++i) {
      expect_post(one + "/replay", path, 201);
      engine->made_replay(i + 1).set_unwatched_s(0.0);
    }
    expect_get(one, open, 404);
    expect_post(one + "/replay", path, 503);
    const std::string newest = json::parse(get(all).body).at("replays").at(0).at("id");
    expect_post(one + "/stop", all + "/" + newest + "/stop", 200);
    expect_get(one, all + "/" + newest, 404);
  }

  void resume(const std::string& path) {
    const std::string pattern = one + "/resume";
    expect_post(pattern, path + "/resume", 400, "{");
    expect_post(pattern, path + "/resume", 403, "", foreign);
    expect_post(pattern, all + "/nobody/resume", 404);
    expect_post(pattern, path + "/resume", 415, "{}", {{"Content-Type", "text/plain"}});
    expect_post(pattern, path + "/resume", 422, R"({"reamer": "spoon"})");
    expect_post(pattern, path + "/resume", 503, R"({"reamer": "missing"})");
    expect_post(pattern, path + "/resume", 200, R"({"reamer": "sphere 20"})");
    expect_post(pattern, path + "/resume", 409);
  }

  void annotations(const std::string& path) {
    const std::string pattern = one + "/annotations",
                      good = R"({"words": "too steep", "place_mm": [1, 2, 3.5]})";
    expect_post(pattern, path + "/annotations", 201, good);
    expect_post(pattern, path + "/annotations", 400, "{");
    expect_post(pattern, path + "/annotations", 403, good, foreign);
    expect_post(pattern, all + "/nobody/annotations", 404, good);
    const std::string ready = create();
    expect_post(pattern, all + "/" + ready + "/annotations", 409, good);
    expect_post(one + "/stop", all + "/" + ready + "/stop", 200);
    expect_post(pattern, path + "/annotations", 413, std::string(options.listen.limits.body_bytes + 1, ' '));
    expect_post(pattern, path + "/annotations", 415, good, {{"Content-Type", "text/plain"}});
    expect_post(pattern, path + "/annotations", 422, R"({"words": ""})");
    expect_get(pattern, path + "/annotations", 200);
    expect_get(pattern, all + "/nobody/annotations", 404);
    expect_post(one + "/stop", path + "/stop", 200);
  }

  void too_many() {
    while (post(all, R"({"case": "planned", "script": "demo"})").status == 201) {
    }
    expect_post(all, all, 503, R"({"case": "planned", "script": "demo"})");
    const HttpReply filled = get(all);
    const json sessions = json::parse(filled.body).at("sessions");
    const auto ended = std::find_if(sessions.begin(), sessions.end(), [](const json& session) {
      return session.at("state") == "stopped" && session.at("followed_by").is_null();
    });
    ASSERT_NE(ended, sessions.end());
    expect_post(one + "/reset", all + "/" + ended->at("id").get<std::string>() + "/reset", 503);
  }
};

TEST_F(ServerContractTest, ServesWhatIsDescribedAndNothingElse) {
  start();
  std::set<std::string> described, served;
  for (const auto& [path, item] : contract.at("paths").items())
    for (const auto& [verb, operation] : item.items())
      if (verb != "parameters") described.insert(upper(verb) + " " + path);
  for (const auto& route : api::routes()) served.insert(route.method + " " + route.pattern);
  EXPECT_EQ(served, described);
}

TEST_F(ServerContractTest, EveryDescribedReplyIsGivenAsDescribed) {
  std::promise<void> release;
  engine->demo_case = [&] { release.get_future().wait(); };
  options.make_demo_case = true;
  folder.write("sessions/earlier/session.json",
               R"({"case": "planned", "script": "demo", "state": "stopped"})");
  start();
  expect_get("/readyz", "/readyz", 503);
  expect_get("/healthz", "/healthz", 200);
  expect_post(all, all, 503, R"({"case": "planned", "script": "demo"})");
  release.set_value();
  while (get("/readyz").status != 200) {
  }
  expect_get("/readyz", "/readyz", 200);
  expect_get("/api/v1/openapi.yaml", "/api/v1/openapi.yaml", 200);
  expect_get("/metrics", "/metrics", 200);
  creation();
  life_of_a_session();
  too_many();

  expect_get(all, all + "?sort=age", 422);
  expect_get(all, all + "?limit=2&state=stopped", 200);

  // While the database is away: SessionRegisterTest.
  expect_all_given({"health", "sessions"}, {{"GET " + all, 503}});
}

TEST_F(ServerContractTest, TakesExactlyTheBodiesThatTheSchemaTakes) {
  options.sessions.live = 100;
  start();
  const json& schema = contract.at("components").at("schemas").at("NewSession");
  for (const char* body : {R"({"case": "planned", "script": "demo"})",
                           R"({"case": "planned", "script": "demo", "force_scale": 1000})",
                           R"({"case": "planned", "script": "demo", "force_scale": 0.001})",
                           R"({"case": "planned", "script": "demo", "force_scale": 0})",
                           R"({"case": "planned", "script": "demo", "force_scale": 1000.1})",
                           R"({"case": "planned", "script": "demo", "force_scale": "1"})",
                           R"({"case": "planned", "script": "demo", "force_scale": null})",
                           R"({"case": "planned"})",
                           R"({"script": "demo"})",
                           "{}",
                           "[]",
                           "null",
                           R"({"case": "../planned", "script": "demo"})",
                           R"({"case": "planned", "script": "/etc/passwd"})",
                           R"({"case": "", "script": "demo"})",
                           R"({"case": 1, "script": true})",
                           R"({"case": "planned", "device": "browser"})",
                           R"({"case": "planned", "device": "../x"})",
                           R"({"case": "planned", "device": null})",
                           R"({"case": "planned", "device": "network", "device_profile": "omega.3"})",
                           R"({"case": "planned", "device": "network", "device_profile": ""})",
                           R"({"case": "planned", "device_profile": 3})",
                           R"({"case": "planned", "script": "demo", "Case": "x"})"}) {
    const json wanted = json::parse(body);
    // The schema leaves the case out for studies, which know it.
    const bool fits = faults(schema, wanted).empty() && wanted.contains("case");
    EXPECT_EQ(post(all, body).status, fits ? 201 : 422) << body;
  }
}

TEST_F(ServerContractTest, TakesExactlyTheChangesOfPlaybackThatTheSchemaTakes) {
  start();
  const std::string ended = create();
  post(all + "/" + ended + "/stop");
  const json made = json::parse(post(all + "/" + ended + "/replay").body);
  const std::string path = all + "/" + made.at("id").get<std::string>() + "/playback";
  const json& schema = contract.at("components").at("schemas").at("PlaybackChange");
  for (const char* body :
       {"{}", "[]", R"({"playing": true})", R"({"playing": 1})", R"({"playing": null})", R"({"speed": 0})",
        R"({"speed": 16})", R"({"speed": 16.1})", R"({"speed": -1})", R"({"speed": "2"})",
        R"({"position_s": 0})", R"({"position_s": 10})", R"({"position_s": -0.1})",
        R"({"position_s": 1, "speed": 2, "playing": false})", R"({"position": 1})"}) {
    const bool fits = faults(schema, json::parse(body)).empty();
    EXPECT_EQ(post(path, body).status, fits ? 200 : 422) << body;
  }
}

TEST_F(ServerContractTest, TakesExactlyTheRemarksThatTheSchemaTakes) {
  start();
  const std::string path = all + "/" + create();
  ASSERT_EQ(post(path + "/start").status, 200);
  const json& schema = contract.at("components").at("schemas").at("NewAnnotation");
  const auto long_words = [](size_t characters) {
    std::string text;
    for (size_t i = 0; i < characters; ++i) text += "\u00e4";
    return json{{"words", text}}.dump();
  };
  for (const std::string& body :
       {std::string(R"({"words": "here"})"), std::string(R"({"words": ""})"), std::string(R"({"words": 3})"),
        std::string("{}"), std::string("[]"), long_words(4000), long_words(4001),
        std::string(R"({"words": "here", "author": "anna"})"),
        std::string(R"({"words": "here", "author": null})"), std::string(R"({"words": "here", "at_s": 0})"),
        std::string(R"({"words": "here", "at_s": -1})"), std::string(R"({"words": "here", "at_s": 1e9})"),
        std::string(R"({"words": "here", "at_s": "1"})"),
        std::string(R"({"words": "here", "place_mm": null})"),
        std::string(R"({"words": "here", "place_mm": [1, 2]})"),
        std::string(R"({"words": "here", "place_mm": [1, 2, 3e6]})"),
        std::string(R"({"words": "here", "place_mm": [1, -2, 3.5]})"),
        std::string(R"({"words": "here", "colour": 1})")}) {
    const bool fits = faults(schema, json::parse(body)).empty();
    EXPECT_EQ(post(path + "/annotations", body).status, fits ? 201 : 422) << body.substr(0, 100);
  }
}

TEST_F(ServerContractTest, TheDescriptionServedIsTheFile) {
  start();
  std::ifstream file(source_folder() + "/proto/openapi.yaml");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(get("/api/v1/openapi.yaml").body, text);
}

}  // namespace
}  // namespace ream::test
