#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include "e2e/cli/serve_fixture.hpp"
#include "support/test_certificate.hpp"

namespace ream::test {
namespace {

using nlohmann::json;
const std::string password = "correct horse battery";

class UserCommand : public Serve {
 protected:
  json add(const std::string& name, const Words& more = {}) {
    Words command = {"user", "add", name, "--json"};
    command.insert(command.end(), more.begin(), more.end());
    const Outcome outcome = run_with_input(command, password + "\n");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    return json::parse(outcome.out);
  }
  std::string token(const std::string& name, const Words& more = {}) {
    Words command = {"user", "token", name};
    command.insert(command.end(), more.begin(), more.end());
    return answer(command).at("secret");
  }
  static Sent bearer(const std::string& secret) { return {{"Authorization", "Bearer " + secret}}; }
  void stop() {
    server_->send_signal(SIGTERM);
    EXPECT_EQ(server_->wait(std::chrono::seconds(20)), 0) << printed("server.err");
  }
};

TEST_F(UserCommand, TheFirstIsAnOperatorAndOthersAreTrainees) {
  EXPECT_EQ(add("Anna").at("role"), "operator");
  EXPECT_EQ(add("ben").at("role"), "trainee");
  EXPECT_EQ(add("ina", {"--role", "instructor", "--display-name", "Dr. Ina"}).at("display_name"), "Dr. Ina");
  const json users = answer({"user", "list"}).at("users");
  ASSERT_EQ(users.size(), 3u);
  EXPECT_EQ(users[0].at("name"), "anna");
  const Outcome shown = succeed({"user", "list"});
  EXPECT_NE(shown.out.find("\tina\tinstructor\n"), std::string::npos) << shown.out;
}

TEST_F(UserCommand, BadInputIsOneLine) {
  const auto refused = [&](int exit_code, const std::string& mentioned, const Words& words,
                           const std::string& input = {}) {
    const Outcome outcome = run_with_input(words, input);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.error;
    EXPECT_NE(outcome.error.find(mentioned), std::string::npos) << outcome.error;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.error.find(password), std::string::npos) << outcome.error;
  };
  refused(1, "first user must be operator", {"user", "add", "ben", "--role", "trainee"}, password);
  refused(1, "no password on stdin", {"user", "add", "anna"});
  refused(1, "at least 10 characters", {"user", "add", "anna"}, "short\n");
  refused(1, "a user's name", {"user", "add", "two words"}, password);
  refused(2, "--role", {"user", "add", "anna", "--role", "king"}, password);
  refused(2, "password", {"user", "add", "anna", "--password", "given for all to read"});
  refused(2, "--help", {"user"});
  add("anna");
  refused(1, "'anna' already", {"user", "add", "anna"}, password);
  refused(1, "no user 'ben'", {"user", "token", "ben"});
  refused(1, "no user 'ben'", {"user", "password", "ben"}, password);
  refused(1, "last operator", {"user", "remove", "anna"});
  refused(1, "last operator", {"user", "role", "anna", "trainee"});
  refused(1, "last operator", {"user", "disable", "anna"});
  refused(1, "no token, link or login", {"user", "revoke", "nothing"});
  add("ben");
  refused(1, "cannot be viewer", {"user", "token", "ben", "--role", "viewer"});
  refused(2, "--expires-days", {"user", "token", "ben", "--expires-days", "400"});
}

/// A terminal that a program can be started on.
class Terminal {
 public:
  Terminal() : master_(::posix_openpt(O_RDWR | O_NOCTTY)) {
    if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0)
      throw std::runtime_error("no terminal can be made");
    // Held open, so that the keys typed ahead are not lost.
    held_ = ::open(name().c_str(), O_RDWR | O_NOCTTY);
  }
  ~Terminal() {
    ::close(held_);
    ::close(master_);
  }
  std::string name() const { return ::ptsname(master_); }
  void type(const std::string& keys) const {
    if (::write(master_, keys.data(), keys.size()) != static_cast<ssize_t>(keys.size()))
      throw std::runtime_error("the terminal takes no keys");
  }
  /// All that was to be seen so far.
  std::string seen() const {
    ::fcntl(master_, F_SETFL, O_NONBLOCK);
    std::string text;
    char bytes[256];
    for (ssize_t n = 0; (n = ::read(master_, bytes, sizeof bytes)) > 0;)
      text.append(bytes, static_cast<size_t>(n));
    return text;
  }

 private:
  int master_, held_ = -1;
};

class AtATerminal : public UserCommand {
 protected:
  /// Types each line when it is asked for; the exit code.
  int add_by_typing(const std::vector<std::string>& lines) {
    input_ = terminal.name();
    const auto adding = start({"user", "add", "anna"}, "add");
    size_t asked = 0;
    for (const std::string& line : lines) {
      for (int i = 0; i < 2000 && printed("add.err").find(": ", asked) == std::string::npos; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      asked = printed("add.err").find(": ", asked) + 2;
      std::this_thread::sleep_for(
          std::chrono::milliseconds(100));  // the terminal falls silent before it asks
      terminal.type(line);
    }
    return adding->wait(std::chrono::seconds(60));
  }
  Terminal terminal;
};

TEST_F(AtATerminal, APasswordIsAskedForTwiceAndNotShown) {
  EXPECT_EQ(add_by_typing({"correct horsX\x7f\x65\x7f"
                           "e battery\n",
                           "correct hors\x7fse battery\n"}),
            0)
      << printed("add.err");
  EXPECT_EQ(terminal.seen().find("horse"), std::string::npos);
  EXPECT_EQ(printed("add.err").find("horse"), std::string::npos);
  input_ = "/dev/null";
  EXPECT_EQ(answer({"user", "list"}).at("users").size(), 1u);
}

TEST_F(AtATerminal, TwoThatDifferAreRefusedAndCtrlCEndsIt) {
  EXPECT_EQ(add_by_typing({"correct horse battery\n", "correct horse batterie\n"}), 1);
  EXPECT_NE(printed("add.err").find("differ"), std::string::npos);
  EXPECT_EQ(add_by_typing({"correct\x03"}), 1);
  EXPECT_NE(printed("add.err").find("nothing was changed"), std::string::npos);
  input_ = "/dev/null";
  EXPECT_TRUE(answer({"user", "list"}).at("users").empty());
}

TEST_F(UserCommand, ARunningServerSeesItWithinSeconds) {
  serve();
  EXPECT_FALSE(said_.contains("viewer_link")) << "everybody may do everything";
  EXPECT_EQ(request(200, "GET", "/api/v1/login").at("login_needed"), false);
  request(200, "GET", "/api/v1/users");
  add("anna");
  until("users are needed", [&] { return http_request(port_, "GET", "/api/v1/users").status == 401; });
  const std::string secret = token("anna");
  request(200, "GET", "/api/v1/users", "", bearer(secret));
  const json shown = answer({"user", "list"});
  answer({"user", "revoke", shown.at("tokens").at(0).at("id").get<std::string>()});
  until("the token is revoked",
        [&] { return http_request(port_, "GET", "/api/v1/users", "", bearer(secret)).status == 401; });
  EXPECT_EQ(
      http_request(port_, "POST", "/api/v1/login", json{{"name", "anna"}, {"password", password}}.dump())
          .status,
      200);
  const Outcome changed = run_with_input({"user", "password", "anna"}, "another good one\n");
  EXPECT_EQ(changed.exit_code, 0) << changed.error;
  request(401, "POST", "/api/v1/login", json{{"name", "anna"}, {"password", password}}.dump());
  request(200, "POST", "/api/v1/login", R"({"name": "anna", "password": "another good one"})");
  stop();
}

TEST_F(UserCommand, WithUsersAServerSaysAViewerLink) {
  add("anna");
  serve();
  const std::string link = said_.at("viewer_link"), mark = "/#watch=";
  ASSERT_NE(link.find(mark), std::string::npos) << link;
  EXPECT_EQ(link.rfind(said_.at("url").get<std::string>(), 0), 0u);
  const std::string secret = link.substr(link.find(mark) + mark.size());
  const json login = request(200, "POST", "/api/v1/login/link", json{{"secret", secret}}.dump());
  EXPECT_EQ(login.at("role"), "viewer");
  EXPECT_EQ(printed("server.err").find(secret), std::string::npos);
  stop();
  server_ = start({"serve", "--port", "0", "--web", "web"}, "server");
  until("it says where it is", [&] { return printed("server.out").ends_with('\n'); });
  EXPECT_EQ(printed("server.out").find("watch"), std::string::npos) << "this is a file, not a terminal";
  stop();
}

TEST_F(UserCommand, OthersReachAServerWithUsersAndTlsOnly) {
  refuse(2, "ream user add", {"serve", "--port", "0", "--host", "0.0.0.0", "--web", "web", "--insecure"});
  add("anna");
  refuse(2, "--tls-cert", {"serve", "--port", "0", "--host", "0.0.0.0", "--web", "web"});
  refuse(2, "go together", {"serve", "--port", "0", "--web", "web", "--tls-cert", "web/index.html"});
  refuse(1, "web/index.html",
         {"serve", "--port", "0", "--web", "web", "--tls-cert", "web/index.html", "--tls-key",
          "web/index.html"});
  write("data/serving.lock", "");
  std::filesystem::create_directories(folder() / "data/sessions");
  refuse(1, "--host 203.0.113.77",
         {"serve", "--port", "0", "--host", "203.0.113.77", "--insecure", "--web", "web"});
  serve({"--host", "0.0.0.0", "--insecure", "--public-name", "ream.example"});
  EXPECT_EQ(said_.at("url"), "http://ream.example:" + std::to_string(port_));
  request(401, "GET", "/api/v1/users");
  EXPECT_EQ(http_request(port_, "GET", "/healthz", "", {{"Host", "ream.example"}}).status, 200);
  EXPECT_EQ(http_request(port_, "GET", "/healthz", "", {{"Host", "evil.example"}}).status, 421);
  stop();
}

TEST_F(UserCommand, ACertificateThatEndsSoonIsSaidOnceAndNotBesideAnError) {
  make_certificate(folder() / "soon.pem", folder() / "soon.key", {-1, 5});
  make_certificate(folder() / "other.pem", folder() / "other.key");
  std::filesystem::create_directories(folder() / "data/sessions");
  refuse(1, "other.key is not the key of the certificate in soon.pem",
         {"serve", "--port", "0", "--web", "web", "--tls-cert", "soon.pem", "--tls-key", "other.key"});
  serve({"--tls-cert", "soon.pem", "--tls-key", "soon.key"});
  EXPECT_EQ(said_.at("url"), "https://127.0.0.1:" + std::to_string(port_));
  const std::string words = printed("server.err"), warning = "soon.pem expires soon";
  EXPECT_NE(words.find(warning), std::string::npos) << words;
  EXPECT_EQ(words.find(warning), words.rfind(warning)) << words;
  stop();
}

TEST_F(UserCommand, ListsSayWhatIsNotThere) {
  EXPECT_NE(succeed({"user", "list"}).error.find("ream user add"), std::string::npos);
  add("anna");
  EXPECT_EQ(succeed({"user", "list"}).error, "");
  token("anna");
  EXPECT_TRUE(succeed({"user", "list"}).out.ends_with("\tnever used\n"));
  EXPECT_EQ(answer({"user", "list"}).at("tokens").at(0).at("last_used_utc"), nullptr);
}

}  // namespace
}  // namespace ream::test
