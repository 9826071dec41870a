#include "net/router.hpp"

#include <gtest/gtest.h>

#include "net/problem.hpp"

namespace ream::net {
namespace {

Request request_for(const std::string& method, const std::string& path) {
  Request request;
  request.method = method;
  request.path = path;
  return request;
}

Response named(int status) {
  Response response;
  response.status = status;
  return response;
}

class RouterTest : public testing::Test {
 protected:
  RouterTest() {
    router.on("GET", "/things", [](const Request&) { return named(200); });
    router.on("POST", "/things", [](const Request&) { return named(201); });
    router.on("GET", "/things/{id}/part/{part}", [this](const Request& request) {
      seen = request.parameters;
      return named(200);
    });
    router.on("POST", "/broken",
              [](const Request&) -> Response { throw Error(ErrorKind::conflict, "not now"); });
    router.on_websocket("/things/{id}/stream",
                        [](const Request& request) -> std::unique_ptr<WebSocketSession> {
                          throw Error(ErrorKind::not_found, "no thing " + request.parameters.at("id"));
                        });
  }
  Router router;
  std::map<std::string, std::string> seen;
};

TEST_F(RouterTest, FindsByMethodAndPath) {
  EXPECT_EQ(router.respond(request_for("GET", "/things")).status, 200);
  EXPECT_EQ(router.respond(request_for("POST", "/things")).status, 201);
  EXPECT_EQ(router.respond(request_for("HEAD", "/things")).status, 200);
}

TEST_F(RouterTest, HandsOverParameters) {
  EXPECT_EQ(router.respond(request_for("GET", "/things/a b/part/7")).status, 200);
  EXPECT_EQ(seen, (std::map<std::string, std::string>{{"id", "a b"}, {"part", "7"}}));
}

TEST_F(RouterTest, UnknownPathIs404AndEmptySegmentMatchesNoParameter) {
  for (const char* path : {"/", "/thing", "/things/", "/things/1", "/things//part/7", "/things/1/part/7/8"})
    EXPECT_EQ(router.respond(request_for("GET", path)).status, 404) << path;
}

TEST_F(RouterTest, WrongMethodIs405WithAllow) {
  const Response response = router.respond(request_for("DELETE", "/things"));
  EXPECT_EQ(response.status, 405);
  EXPECT_EQ(response.header("Allow"), "GET, HEAD, POST");
}

TEST_F(RouterTest, ErrorsBecomeProblems) {
  const Response response = router.respond(request_for("POST", "/broken"));
  EXPECT_EQ(response.status, 409);
  EXPECT_EQ(response.content_type, "application/problem+json");
}

TEST_F(RouterTest, WebSocketPathAskedPlainlyWantsUpgrade) {
  EXPECT_EQ(router.respond(request_for("GET", "/things/1/stream")).status, 426);
  EXPECT_EQ(router.open(request_for("GET", "/things/1/stream")).refusal.status, 404);
  EXPECT_EQ(router.open(request_for("GET", "/things")).refusal.status, 404);
}

TEST_F(RouterTest, GateIsAskedBeforeEveryHandlerAndMayRefuse) {
  std::vector<std::string> asked;
  router.otherwise([](const Request& request) {
    EXPECT_EQ(request.caller.name, "Ada");
    return named(200);
  });
  router.guard([&](Request& request, const std::string& pattern) {
    asked.push_back(pattern);
    if (request.method == "POST") throw RequestError(403, "not for you");
    request.caller.name = "Ada";
  });
  EXPECT_EQ(router.respond(request_for("GET", "/things")).status, 200);
  EXPECT_EQ(router.respond(request_for("POST", "/things")).status, 403);
  EXPECT_EQ(router.respond(request_for("GET", "/page.css")).status, 200);
  EXPECT_EQ(router.open(request_for("GET", "/things/7/stream")).refusal.status, 404);
  EXPECT_EQ(asked, (std::vector<std::string>{"/things", "/things", "", "/things/{id}/stream"}));
  router.guard([](Request&, const std::string&) { throw RequestError(403, "nobody"); });
  EXPECT_EQ(router.open(request_for("GET", "/things/7/stream")).refusal.status, 403);
}

TEST_F(RouterTest, ACallerIsPacedByUserOrCredentialAndNobodyElse) {
  router.pace_callers({0.001, 2.0});
  router.guard([](Request& request, const std::string&) {
    request.caller.user_id = request.query["user"];
    request.caller.credential = request.query["credential"];
  });
  const auto ask = [&](const std::string& user, const std::string& credential) {
    Request request = request_for("GET", "/things");
    request.query = {{"user", user}, {"credential", credential}};
    return router.respond(request);
  };
  for (int i = 0; i < 2; ++i) EXPECT_EQ(ask("ada", "token-" + std::to_string(i)).status, 200);
  EXPECT_EQ(ask("ada", "token-3").status, 429);
  EXPECT_FALSE(ask("ada", "token-3").header("Retry-After").empty());
  for (int i = 0; i < 2; ++i) EXPECT_EQ(ask("", "link-1").status, 200);
  EXPECT_EQ(ask("", "link-1").status, 429);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(ask("", "").status, 200);
  Request watch = request_for("GET", "/things/1/stream");
  watch.query["user"] = "ada";
  EXPECT_EQ(router.open(watch).refusal.status, 429);
}

/// Says nothing.
class SilentSession final : public WebSocketSession {
 public:
  void on_open(std::function<void()>) override {}
  std::optional<SharedBytes> next() override { return std::nullopt; }
  void on_message(std::span<const std::byte>) override {}
  void on_close() noexcept override {}
};

TEST(RouterWrapping, IsPutAroundEveryWebSocketThatOpens) {
  Router routes;
  routes.on_websocket("/stream", [](const Request& request) {
    if (request.header("x-refuse") == "yes") throw RequestError(409, "not now");
    return std::make_unique<SilentSession>();
  });
  routes.guard([](Request& request, const std::string&) { request.caller.name = "Ada"; });
  int wrapped = 0;
  routes.wrap_websockets([&](const Request& request, std::unique_ptr<WebSocketSession> session) {
    EXPECT_EQ(request.caller.name, "Ada");
    EXPECT_TRUE(session);
    ++wrapped;
    return session;
  });
  Request request;
  request.method = "GET";
  request.path = "/stream";
  EXPECT_TRUE(routes.open(request).session);
  EXPECT_EQ(wrapped, 1);
  request.headers["x-refuse"] = "yes";
  EXPECT_EQ(routes.open(request).refusal.status, 409);
  EXPECT_EQ(wrapped, 1);
}

TEST_F(RouterTest, OtherwiseAnswersReadsOnly) {
  router.otherwise([](const Request&) { return named(304); });
  EXPECT_EQ(router.respond(request_for("GET", "/nowhere")).status, 304);
  EXPECT_EQ(router.respond(request_for("POST", "/nowhere")).status, 405);
}

}  // namespace
}  // namespace ream::net
