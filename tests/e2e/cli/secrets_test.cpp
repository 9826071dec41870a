#include <signal.h>

#include <fstream>
#include <sstream>

#include "e2e/cli/serve_fixture.hpp"
#include "support/postgres_server.hpp"

namespace ream::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string contents_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// A whole run in which every kind of secret is used, rightly and wrongly; then all that it has left and said
/// is searched for them.
class Secrets : public Serve {
 protected:
  const std::string password = "correct horse battery", wrong = "wrong donkey accumulator",
                    changed = "third mule capacitor";

  void keep(const std::string& name, const std::string& secret) {
    EXPECT_GE(secret.size(), 10u) << name;
    secrets_[name] = secret;
  }
  /// A request whose refusals and addresses are searched in the end.
  HttpReply ask(const std::string& method, const std::string& path, const Sent& sent = {},
                const std::string& body = {}) {
    HttpReply reply = http_request(port_, method, path, body, sent);
    if (reply.status >= 300) said_aloud_ += reply.body + '\n';
    for (const char* header : {"location", "www-authenticate"})
      if (reply.headers.contains(header)) said_aloud_ += reply.headers.at(header) + '\n';
    return reply;
  }
  json asked(int status, const std::string& method, const std::string& path, const Sent& sent = {},
             const json& body = nullptr) {
    const HttpReply reply = ask(method, path, sent, body.is_null() ? "" : body.dump());
    EXPECT_EQ(reply.status, status) << method << ' ' << path << ' ' << reply.body;
    return reply.body.empty() ? json() : json::parse(reply.body);
  }
  Sent page_after(const std::string& name, const HttpReply& reply) {
    EXPECT_EQ(reply.status, 200) << reply.body;
    const std::string cookie = reply.headers.at("set-cookie");
    const std::string pair = cookie.substr(0, cookie.find(';'));
    keep(name + "'s cookie", pair.substr(pair.find('=') + 1));
    keep(name + "'s token against forgery", json::parse(reply.body).at("csrf_token"));
    return {{"Cookie", pair}, {"X-CSRF-Token", json::parse(reply.body).at("csrf_token")}};
  }
  void note_arguments(pid_t process) {
    said_aloud_ += contents_of("/proc/" + std::to_string(process) + "/cmdline") + '\n';
  }

  void use_passwords() {
    keep("password", password);
    keep("wrong password", wrong);
    keep("new password", changed);
    asked(401, "POST", "/api/v1/login", {}, {{"name", "anna"}, {"password", wrong}});
    asked(401, "POST", "/api/v1/login", {}, {{"name", wrong}, {"password", "x"}});
    asked(422, "POST", "/api/v1/login", {}, {{"name", "anna"}, {"passwort", password}});
    asked(422, "POST", "/api/v1/login", {}, {{"name", "anna"}, {"password", {password}}});
    asked(422, "POST", "/api/v1/login", {},
          {{"name", std::string(300, 'x') + password}, {"password", password}});
    asked(401, "GET", "/api/v1/login", {{"Authorization", password}});
    EXPECT_EQ(ask("POST", "/api/v1/login", {}, "{\"name\": \"anna\", \"password\": \"" + password).status,
              400);
    EXPECT_EQ(ask("POST", "/api/v1/login", {{"Content-Type", "text/plain"}}, password).status, 415);
    page_ = page_after(
        "anna", ask("POST", "/api/v1/login", {}, json{{"name", "anna"}, {"password", password}}.dump()));
    asked(422, "POST", "/api/v1/login/password", page_, {{"password", wrong}, {"new_password", changed}});
    asked(422, "POST", "/api/v1/login/password", page_, {{"password", password}, {"new_password", "short"}});
    asked(204, "POST", "/api/v1/login/password", page_, {{"password", password}, {"new_password", changed}});
    keep("trainee's password", "tom's own password");
    asked(422, "POST", "/api/v1/users", page_,
          {{"name", "tom tom"}, {"role", "trainee"}, {"password", "tom's own password"}});
    asked(201, "POST", "/api/v1/users", page_,
          {{"name", "tom"}, {"role", "trainee"}, {"password", "tom's own password"}});
  }

  void use_tokens_and_links() {
    const json token = asked(201, "POST", "/api/v1/tokens", page_, {{"name", "robot"}});
    keep("token", token.at("secret"));
    const std::string secret = token.at("secret");
    asked(200, "GET", "/api/v1/users", {{"Authorization", "Bearer " + secret}});
    asked(401, "GET", "/api/v1/users", {{"Authorization", "Bearer " + secret + "x"}});
    asked(401, "GET", "/api/v1/users", {{"Authorization", "Basic " + secret}});
    asked(403, "DELETE", "/api/v1/login", {{"Cookie", page_.at("Cookie")}, {"X-CSRF-Token", "forged"}});
    const json session = asked(201, "POST", "/api/v1/sessions", {{"Authorization", "Bearer " + secret}},
                               {{"case", "demo"}, {"script", "demo"}});
    const std::string path = "/api/v1/sessions/" + session.at("id").get<std::string>();
    {
      const RawWebSocket stream(port_, path + "/stream", {{"Authorization", "Bearer " + secret}});
      EXPECT_EQ(stream.handshake().status, 101);
    }
    const json link = asked(201, "POST", "/api/v1/links", page_, {{"session", session.at("id")}});
    keep("link", link.at("secret"));
    keep("the server's own link",
         std::string(said_.at("viewer_link")).substr(std::string(said_.at("viewer_link")).find('=') + 1));
    asked(401, "POST", "/api/v1/login/link", {}, {{"secret", link.at("secret").get<std::string>() + "x"}});
    const Sent guest = page_after(
        "guest", ask("POST", "/api/v1/login/link", {}, json{{"secret", link.at("secret")}}.dump()));
    asked(403, "POST", path + "/start", guest);
    asked(204, "DELETE", "/api/v1/tokens/" + token.at("id").get<std::string>(), page_);
    asked(401, "GET", "/api/v1/users", {{"Authorization", "Bearer " + secret}});
    const json by_command = answer({"user", "token", "anna", "--for", "a second robot"});
    keep("token of the command line", by_command.at("secret"));
    for (const char* list : {"users", "tokens", "links", "audit"})
      said_aloud_ += asked(200, "GET", "/api/v1/" + std::string(list), page_).dump() + '\n';
    said_aloud_ += answer({"user", "list"}).dump() + '\n';
  }

  /// What of `text` is a secret.
  void expect_none_in(const std::string& place, const std::string& text) {
    for (const auto& [name, secret] : secrets_)
      EXPECT_EQ(text.find(secret), std::string::npos) << place << " holds the " << name;
  }

  std::map<std::string, std::string> secrets_;
  std::string said_aloud_;  ///< refusals, addresses, lists, arguments
  Sent page_;
};

TEST_F(Secrets, AreNowhereAfterAWholeRun) {
  const Outcome added = run_with_input({"user", "add", "anna"}, password + "\n");
  ASSERT_EQ(added.exit_code, 0) << added.error;
  said_aloud_ += added.out + added.error;
  serve();
  until("it is ready", [&] { return http_request(port_, "GET", "/readyz").status == 200; });
  use_passwords();
  use_tokens_and_links();
  note_arguments(server_->id());
  while (ask("POST", "/api/v1/login", {}, json{{"name", "anna"}, {"password", wrong}}.dump()).status == 401) {
  }
  const std::string in_use =
      contents_of(folder() / "data/ream.db") + contents_of(folder() / "data/ream.db-wal");
  expect_none_in("a database in use", in_use);
  EXPECT_NE(in_use.find("second robot"), std::string::npos) << "it is searched where things are kept";
  EXPECT_NE(said_aloud_.find("name or password is wrong"), std::string::npos);
  server_->send_signal(SIGTERM);
  EXPECT_EQ(server_->wait(std::chrono::seconds(30)), 0) << printed("server.err");
  expect_none_in("what was said", said_aloud_);
  expect_none_in("the log", printed("server.err"));
  size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder())) {
    if (!entry.is_regular_file()) continue;
    expect_none_in(entry.path().string(), contents_of(entry.path()));
    ++files;
  }
  EXPECT_GE(files, 3u);
  secrets_.erase("the server's own link");  // which the program that asked with --json is told
  expect_none_in("stdout", printed("server.out"));
}

TEST_F(Secrets, ThePasswordOfTheDatabaseIsNotTold) {
  const std::string secret = "pg-hidden-pass";
  std::string url = PostgresServer::shared().make_database();
  const size_t at = url.find('@'), host = url.find("//") + 2;
  url.insert(at == std::string::npos ? host : at,
             (at == std::string::npos ? "postgres:" : ":") + secret + (at == std::string::npos ? "@" : ""));
  keep("database password", secret);
  environment_["REAM_DB"] = url;
  serve();
  note_arguments(server_->id());
  until("it is ready", [&] { return http_request(port_, "GET", "/readyz").status == 200; });
  asked(200, "GET", "/api/v1/login");
  PostgresServer::shared().stop();
  asked(503, "POST", "/api/v1/login", {}, {{"name", "anna"}, {"password", "does not matter"}});
  const Outcome unreachable = run({"user", "list"});
  EXPECT_EQ(unreachable.exit_code, 1);
  PostgresServer::shared().start();
  server_->send_signal(SIGTERM);
  EXPECT_EQ(server_->wait(std::chrono::seconds(30)), 0);
  environment_.clear();
  const Outcome refused = run({"user", "list", "--db", "postgresql://anna:" + secret + "@127.0.0.1:1/ream"});
  EXPECT_EQ(refused.exit_code, 2);
  expect_none_in("what was said", said_aloud_ + unreachable.error + refused.error);
  expect_none_in("the log", printed("server.err") + printed("server.out"));
}

}  // namespace
}  // namespace ream::test
