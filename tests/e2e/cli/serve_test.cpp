#include <signal.h>

#include "core/hash.hpp"
#include "e2e/cli/serve_fixture.hpp"
#include "record/recording.hpp"

namespace ream::test {
namespace {

using nlohmann::json;

TEST_F(Serve, ToldToEndItEndsTheSessionWholeAndQuickly) {
  serve();
  until("it is ready", [&] { return http_request(port_, "GET", "/readyz").status == 200; });
  const std::string id =
      request(201, "POST", "/api/v1/sessions", R"({"case": "demo", "script": "demo"})").at("id");
  const std::string session = "/api/v1/sessions/" + id;
  request(200, "POST", session + "/start");
  until("two seconds are simulated",
        [&] { return request(200, "GET", session + "/metrics").at("duration_s").get<double>() > 2.0; });

  server_->send_signal(SIGTERM);
  EXPECT_EQ(server_->wait(std::chrono::seconds(20)), 0) << printed("server.err");
  const std::string folder = "data/sessions/" + id;
  const json metrics = json_of(folder + "/metrics.json");
  EXPECT_GT(metrics.at("duration_s").get<double>(), 2.0);
  EXPECT_LT(metrics.at("duration_s").get<double>(), 30.0);
  EXPECT_EQ(json_of(folder + "/session.json").at("state"), "stopped");
  const record::Recording recording(this->folder() / folder / "recording.ream");
  EXPECT_EQ(recording.log().damage(), "");
  ASSERT_TRUE(recording.end());
  EXPECT_EQ(recording.end()->state, "stopped");
  EXPECT_DOUBLE_EQ(recording.tick_count() * 1e-3, metrics.at("duration_s").get<double>());
  EXPECT_EQ(to_hex(recording.checkpoints().back().session_hash), metrics.at("session_hash"));
  for (const std::string& entry : tree()) EXPECT_EQ(entry.find(".tmp"), std::string::npos) << entry;
  EXPECT_EQ(answer({"list", "sessions"}).at(0).at("id"), id);
}

TEST_F(Serve, APortInUseAndAddressesForOthersAreRefused) {
  serve();
  until("it is ready", [&] { return http_request(port_, "GET", "/readyz").status == 200; });
  const std::string port = std::to_string(port_);
  succeed({"user", "list", "--data", "other"});
  write("other/serving.lock", "");
  std::filesystem::create_directories(folder() / "other/sessions");
  refuse(1, "port " + port, {"serve", "--port", port, "--web", "web", "--json", "--data", "other"});
  refuse(2, "--host 0.0.0.0", {"serve", "--port", "0", "--host", "0.0.0.0", "--web", "web"});
  refuse(2, "--port", {"serve", "--port", "99999", "--web", "web"});
  refuse(1, "nowhere", {"serve", "--port", "0", "--web", "nowhere"});
  refuse(1, "web/index.html/data", {"serve", "--port", "0", "--web", "web", "--data", "web/index.html/data"});
  EXPECT_EQ(http_request(port_, "GET", "/healthz").status, 200) << "the first server goes on";
  server_->send_signal(SIGINT);
  EXPECT_EQ(server_->wait(std::chrono::seconds(20)), 0);
}

TEST_F(Serve, ADataFolderHasOneServer) {
  serve();
  until("it is ready", [&] { return http_request(port_, "GET", "/readyz").status == 200; });
  refuse(1, "a server runs on " + (folder() / "data").string(), {"serve", "--port", "0", "--web", "web"});
  EXPECT_EQ(http_request(port_, "GET", "/healthz").status, 200) << "the first server goes on";
  server_->send_signal(SIGKILL);
  server_->wait(std::chrono::seconds(20));
  serve();
  server_->send_signal(SIGTERM);
  EXPECT_EQ(server_->wait(std::chrono::seconds(20)), 0);
}

TEST_F(Serve, DatabasesAndFoldersThatCannotBeUsedAreNamed) {
  std::filesystem::create_directories(folder() / "a folder");
  write("no database.db", "hello");
  const auto mode = std::filesystem::status(folder() / "a folder").permissions();
  for (const Words& command : {Words{"serve", "--port", "0", "--web", "web"}, Words{"user", "list"},
                               Words{"list", "sessions"}, Words{"backup", "a.zip"}}) {
    const auto with = [&](const std::string& url) {
      Words words = command;
      words.insert(words.end(), {"--db", url});
      return words;
    };
    refuse(2, "sqlite:FILE", with("ream.db"));
    refuse(2, "sqlite:FILE", with("mysql://me@127.0.0.1/ream"));
    refuse(2, "REAM_DB", with("postgresql://me:secret@127.0.0.1/ream"));
    if (command.front() == "list" || command.front() == "backup") continue;
    refuse(2, "a folder is no file", with("sqlite:a folder"));
    refuse(1, "no database.db", with("sqlite:no database.db"));
    refuse(1, "not/there", with("sqlite:not/there/ream.db"));
    refuse(1, "postgresql://127.0.0.1:1/ream does not answer", with("postgresql://me@127.0.0.1:1/ream"));
  }
  EXPECT_EQ(std::filesystem::status(folder() / "a folder").permissions(), mode);
  refuse(1, "--data", {"serve", "--port", "0", "--web", "web", "--data", "web/index.html/data"});
  refuse(1, "--data", {"user", "list", "--data", "web/index.html"});
}

TEST_F(Serve, BadRequestsAreProblems) {
  serve();
  until("it is ready", [&] { return http_request(port_, "GET", "/readyz").status == 200; });
  for (const auto& [status, body] : std::vector<std::pair<int, std::string>>{
           {400, "{"},
           {422, R"({"script": "demo"})"},
           {422, R"({"case": "demo", "device": "spoon"})"},
           {422, R"({"case": "demo", "script": "demo", "colour": "red"})"},
           {404, R"({"case": "nobody", "script": "demo"})"},
           {404, R"({"case": "demo", "script": "nothing"})"}}) {
    const HttpReply reply = http_request(port_, "POST", "/api/v1/sessions", body);
    EXPECT_EQ(reply.status, status) << body << '\n' << reply.body;
    EXPECT_EQ(reply.headers.at("content-type"), "application/problem+json") << body;
    EXPECT_EQ(json::parse(reply.body).at("status"), status) << body;
  }
  EXPECT_EQ(request(200, "GET", "/api/v1/sessions").dump().find("created"), std::string::npos);
}

}  // namespace
}  // namespace ream::test
