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

/// Lets everything pass, as long as a test does not say otherwise.
struct OpenPolicy : RequestPolicy {
  void authorize(Request&, size_t) const override {}
  void check(Request&, size_t) const override {}
  Response answer(const Request& request, size_t, const Handler& next) const override {
    return next(request);
  }
  std::unique_ptr<WebSocketSession> opened(const Request&, size_t,
                                           std::unique_ptr<WebSocketSession> session) const override {
    return session;
  }
};

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

TEST_F(RouterTest, PolicyIsAskedBeforeEveryHandlerOfARouteAndMayRefuse) {
  struct Policy : OpenPolicy {
    mutable std::vector<size_t> asked;
    void authorize(Request& request, size_t route) const override {
      asked.push_back(route);
      if (request.method == "POST") throw RequestError(403, "not for you");
      request.caller.name = "Ada";
    }
    Response answer(const Request& request, size_t, const Handler& next) const override {
      EXPECT_EQ(request.caller.name, "Ada");
      return next(request);
    }
  } policy;
  router.otherwise([](const Request&) { return named(200); });
  router.follow(policy);
  EXPECT_EQ(router.respond(request_for("GET", "/things")).status, 200);
  EXPECT_EQ(router.respond(request_for("POST", "/things")).status, 403);
  EXPECT_EQ(router.respond(request_for("GET", "/page.css")).status, 200);
  EXPECT_EQ(router.open(request_for("GET", "/things/7/stream")).refusal.status, 404);
  EXPECT_EQ(policy.asked, (std::vector<size_t>{0, 1, 4})) << "files are for everybody";
  struct Closed : OpenPolicy {
    void authorize(Request&, size_t) const override { throw RequestError(403, "nobody"); }
  } closed;
  router.follow(closed);
  EXPECT_EQ(router.open(request_for("GET", "/things/7/stream")).refusal.status, 403);
}

TEST_F(RouterTest, PolicyChecksWhoMayAndStandsAroundHandlers) {
  struct Policy : OpenPolicy {
    mutable std::vector<std::string> steps;
    void authorize(Request&, size_t) const override { steps.push_back("authorize"); }
    void check(Request& request, size_t) const override {
      steps.push_back("check");
      if (request.query.contains("odd")) throw RequestError(422, "makes no sense");
    }
    Response answer(const Request& request, size_t route, const Handler& next) const override {
      steps.push_back("answer " + std::to_string(route));
      return named(next(request).status + 1);
    }
  } policy;
  router.follow(policy);
  EXPECT_EQ(router.respond(request_for("POST", "/things")).status, 202);
  EXPECT_EQ(policy.steps, (std::vector<std::string>{"authorize", "check", "answer 1"}));
  Request odd = request_for("GET", "/things/1/stream");
  odd.query["odd"] = "yes";
  EXPECT_EQ(router.open(odd).refusal.status, 422);
}

TEST_F(RouterTest, ACallerIsPacedByUserOrCredentialAndNobodyElse) {
  router.pace_callers({0.001, 2.0});
  struct Policy : OpenPolicy {
    void authorize(Request& request, size_t) const override {
      request.caller.user_id = request.query["user"];
      request.caller.credential = request.query["credential"];
    }
  } policy;
  router.follow(policy);
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
  struct Policy : OpenPolicy {
    mutable int wrapped = 0;
    void authorize(Request& request, size_t) const override { request.caller.name = "Ada"; }
    std::unique_ptr<WebSocketSession> opened(const Request& request, size_t,
                                             std::unique_ptr<WebSocketSession> session) const override {
      EXPECT_EQ(request.caller.name, "Ada");
      EXPECT_TRUE(session);
      ++wrapped;
      return session;
    }
  } policy;
  routes.follow(policy);
  Request request;
  request.method = "GET";
  request.path = "/stream";
  EXPECT_TRUE(routes.open(request).session);
  EXPECT_EQ(policy.wrapped, 1);
  request.headers["x-refuse"] = "yes";
  EXPECT_EQ(routes.open(request).refusal.status, 409);
  EXPECT_EQ(policy.wrapped, 1);
}

TEST_F(RouterTest, OtherwiseAnswersReadsOnly) {
  router.otherwise([](const Request&) { return named(304); });
  EXPECT_EQ(router.respond(request_for("GET", "/nowhere")).status, 304);
  EXPECT_EQ(router.respond(request_for("POST", "/nowhere")).status, 405);
}

TEST_F(RouterTest, WhateverAHandlerThrowsHasAnAnswer) {
  struct Wordless {};
  router.on("GET", "/full", [](const Request&) -> Response { throw std::bad_alloc(); });
  router.on("GET", "/odd", [](const Request&) -> Response { throw Wordless(); });
  router.on_websocket("/odd/stream",
                      [](const Request&) -> std::unique_ptr<WebSocketSession> { throw Wordless(); });
  EXPECT_EQ(router.respond(request_for("GET", "/full")).status, 503);
  EXPECT_EQ(router.respond(request_for("GET", "/odd")).status, 500);
  EXPECT_EQ(router.open(request_for("GET", "/odd/stream")).refusal.status, 500);
}

}  // namespace
}  // namespace ream::net
