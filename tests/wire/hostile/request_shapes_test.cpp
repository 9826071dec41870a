// Requests that are not what they seem.
#include <regex>

#include "hostile_fixture.hpp"

namespace ream::test {
namespace {

class RequestShapesTest : public HostileTest {
 protected:
  /// Sends and hangs up; everything that came back.
  std::string tell(const std::string& bytes) {
    RawSocket socket(port());
    socket.try_send(bytes);
    socket.end_sending();
    return socket.receive_all();
  }
  static size_t replies_in(const std::string& text) {
    static const std::regex status_line("HTTP/1\\.1 [0-9]{3} ");
    return static_cast<size_t>(
        std::distance(std::sregex_iterator(text.begin(), text.end(), status_line), std::sregex_iterator()));
  }
};

TEST_F(RequestShapesTest, NoSecondRequestIsSmuggledBehindABrokenOne) {
  start();
  const std::string hidden = get_head("/healthz") + "\r\n";
  const std::string length = "Content-Length: " + std::to_string(hidden.size()) + "\r\n";
  const std::string post = "POST /api/v1/sessions HTTP/1.1\r\nHost: localhost\r\n";
  for (const std::string& lines :
       {length + "Content-Length: 0\r\n", std::string("Content-Length: 0\r\n") + length,
        length + "Transfer-Encoding: chunked\r\n", "Transfer-Encoding: chunked\r\n" + length,
        std::string("Transfer-Encoding: xchunked\r\n"), "Transfer-Encoding: chunked, identity\r\n" + length,
        std::string("Transfer-Encoding : chunked\r\n"),
        std::string("Transfer-Encoding:\x0b"
                    "chunked\r\n"),
        std::string("X: y\r\n Transfer-Encoding: chunked\r\n"),
        std::string("X: y\nTransfer-Encoding: chunked\r\n"),
        std::string("X: y\rTransfer-Encoding: chunked\r\n"), std::string("Content-Length: 0, 5\r\n"),
        std::string("Content-Length: +0\r\n"), std::string("X: \0y\r\n", 7),
        std::string("Host: other\r\n")}) {
    const std::string answer = tell(post + lines + "\r\n" + hidden);
    EXPECT_EQ(replies_in(answer), 1u) << lines << answer;
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 400 ")) << lines << answer;
    EXPECT_NE(answer.find("Connection: close\r\n"), std::string::npos) << lines;
  }
  // A body that is refused is not read as the next request either.
  const std::string refused =
      tell("POST /nowhere HTTP/1.1\r\nHost: evil.example\r\n" + length + "\r\n" + hidden);
  EXPECT_EQ(replies_in(refused), 1u) << refused;
}

TEST_F(RequestShapesTest, PipelinedRequestsAreAnsweredInOrder) {
  start();
  std::string all;
  for (int i = 0; i < 200; ++i) all += get_head("/api/v1/sessions/none-" + std::to_string(i)) + "\r\n";
  const std::string answers = tell(all);
  EXPECT_EQ(replies_in(answers), 200u);
  size_t at = 0;
  for (int i = 0; i < 200; ++i) {
    at = answers.find("'none-" + std::to_string(i) + "'", at);
    ASSERT_NE(at, std::string::npos) << i;
  }
}

TEST_F(RequestShapesTest, NothingOutsideThePageIsServed) {
  server_files().write("web/index.html", "<html>page</html>");
  server_files().write("web/assets/a.js", "script");
  server_files().write("secret.txt", "top secret");
  server_files().write("web-secret/file.txt", "top secret");
  std::filesystem::create_symlink("../secret.txt", server_files().path() / "web/link.txt");
  std::filesystem::create_directory_symlink("..", server_files().path() / "web/up");
  start();
  EXPECT_NE(tell(get_head("/index.html") + "\r\n").find("page"), std::string::npos);
  for (const char* path : {"/../secret.txt",
                           "/%2e%2e/secret.txt",
                           "/%2E%2E/secret.txt",
                           "/.%2e/secret.txt",
                           "/..%2fsecret.txt",
                           "/%2e%2e%2fsecret.txt",
                           "/assets/../../secret.txt",
                           "/assets/%2e%2e/%2e%2e/secret.txt",
                           "/..%5csecret.txt",
                           "/..\\secret.txt",
                           "/%252e%252e/secret.txt",
                           "/..;/secret.txt",
                           "//secret.txt",
                           "/./../secret.txt",
                           "/index.html/../../secret.txt",
                           "/../web-secret/file.txt",
                           "/link.txt",
                           "/up/secret.txt",
                           "/%00/../secret.txt",
                           "/..%00/secret.txt",
                           "/%c0%ae%c0%ae/secret.txt",
                           "/\xc0\xae\xc0\xae/secret.txt",
                           "/proc/self/environ",
                           "//etc/passwd",
                           "/etc/passwd",
                           "/file:///etc/passwd",
                           "/assets/a.js%00.html",
                           "/ /../secret.txt"}) {
    const std::string answer = tell(get_head(path) + "\r\n");
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 40")) << path << answer;
    EXPECT_EQ(answer.find("top secret"), std::string::npos) << path;
    EXPECT_EQ(answer.find("root:"), std::string::npos) << path;
  }
}

TEST_F(RequestShapesTest, SecretsOfARequestNeverComeBack) {
  start();
  const std::string secret = "s3cr3t-0123456789abcdef";
  const std::string lines = "Authorization: Bearer " + secret + "\r\nCookie: ream_session=" + secret +
                            "\r\nX-CSRF-Token: " + secret + "\r\n";
  const std::string query = "?token=" + secret + "&key=" + secret + "&limit=" + secret + "&stride=" + secret;
  const std::string id = "/api/v1/sessions/" + session();
  for (const std::string& request :
       {get_head("/nowhere" + query) + lines, get_head("/api/v1/sessions" + query) + lines,
        get_head(id + query) + lines, get_head(id + "/stream" + query) + lines,
        get_head("/api/v1/cases" + query) + lines, get_head("/" + query + "%zz") + lines,
        "DELETE /healthz" + query + " HTTP/1.1\r\nHost: localhost\r\n" + lines,
        "POST /api/v1/sessions" + query + " HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0\r\n" + lines,
        "GET / HTTP/1.1\r\nHost: evil.example\r\n" + lines,
        get_head("/") + lines + " folded: " + secret + "\r\n",
        get_head("/") + lines + "Content-Length: " + secret + "\r\n", get_head("/") + lines + secret + "\r\n",
        get_head("/") + "Range: bytes=" + secret + "\r\nIf-None-Match: \"" + secret + "\"\r\n" + lines,
        "GET /\x01" + secret + " HTTP/1.1\r\nHost: localhost\r\n" + lines}) {
    const std::string answer = tell(request + "\r\n");
    EXPECT_GE(replies_in(answer), 1u) << request;
    EXPECT_EQ(answer.find(secret), std::string::npos) << request << "\n" << answer;
  }
}

TEST_F(RequestShapesTest, EveryAnswerForbidsWhatBrowsersMightDo) {
  start();
  for (const std::string& request : {get_head("/nowhere"), get_head("/healthz"), std::string("BAD\r\n"),
                                     std::string("GET / HTTP/1.1\r\nHost: evil.example\r\n")}) {
    const std::string answer = tell(request + "\r\n");
    for (const char* header :
         {"Content-Security-Policy: default-src 'self'", "X-Content-Type-Options: nosniff",
          "Referrer-Policy: no-referrer", "frame-ancestors 'none'"})
      EXPECT_NE(answer.find(header), std::string::npos) << request << header;
    EXPECT_EQ(answer.find("\r\nServer:"), std::string::npos);
  }
}

}  // namespace
}  // namespace ream::test
