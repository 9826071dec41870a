#include "api/authorizer.hpp"

#include <algorithm>

#include "access/secret.hpp"
#include "api/login_cookie.hpp"
#include "api/routes.hpp"
#include "net/client_address.hpp"
#include "net/problem.hpp"
#include "support/expect_error.hpp"
#include "support/test_databases.hpp"

namespace ream::api {
namespace {

using access::CredentialKind;
using access::Role;

const Route& route_of(const std::string& method, const std::string& pattern) {
  const std::string asked = method == "HEAD" ? "GET" : method;
  const auto found = std::find_if(routes().begin(), routes().end(), [&](const Route& route) {
    return route.method == asked && route.pattern == pattern;
  });
  EXPECT_NE(found, routes().end()) << method << ' ' << pattern;
  return *found;
}

class GateTest : public test::TestDatabase<test::OnSqlite>, protected SessionFinder {
 protected:
  void add_users() {
    anna = add("anna", Role::operator_);
    tom = add("tom", Role::trainee);
  }
  std::string add(const std::string& name, Role role) {
    return access_control.users.add({name, "", role, access::Secret("password of " + name)}).id;
  }
  access::Secret secret(CredentialKind kind, const std::string& user) {
    return access_control.credentials.issue(kind, {user, {}, "", "", ""}).secret;
  }
  static net::Request request(const std::string& method) {
    net::Request made;
    made.method = method;
    made.peer = "10.0.0.7";
    return made;
  }
  net::Request with_token(const std::string& method, const std::string& user) {
    net::Request made = request(method);
    made.headers["authorization"] = "Bearer " + secret(CredentialKind::token, user).reveal();
    return made;
  }
  net::Request with_cookie(const std::string& method, const std::string& user) {
    const access::Secret cookie = secret(CredentialKind::cookie, user);
    net::Request made = request(method);
    made.headers["cookie"] = "theme=dark; ream_session=" + cookie.reveal() + "; other=1";
    made.headers["x-csrf-token"] = access::csrf_token_of(cookie);
    return made;
  }
  /// 0: passes.
  int refusal(net::Request asked, const std::string& pattern) {
    try {
      authorizer.authorize(asked, route_of(asked.method, pattern));
      return 0;
    } catch (const net::RequestError& refused) {
      return refused.status();
    } catch (const Error& refused) {
      return net::http_status(refused.kind());
    }
  }

  bool is_replay(const std::string& id) const override { return id == "replay23"; }
  bool hides_results(const net::Caller& caller, const std::string& id) const override {
    return (id == "felt2345" || id == "replay23") && caller.role != "operator";
  }
  bool is_rated_by(const net::Caller& caller, const std::string& id) const override {
    return rated.contains({caller.user_id, id});
  }
  std::optional<session::SessionRequest> session_of(const std::string& id) const override {
    if (id != "toms" && id != "others") return std::nullopt;
    session::SessionRequest found;
    found.id = id;
    found.trainee_id = id == "toms" ? tom : "somebody else";
    return found;
  }

  access::AccessControl access_control{database(), {machine_clock(), {}, {1, size_t{8} << 10}, 2}};
  Authorizer authorizer{access_control, *this};
  std::set<std::pair<std::string, std::string>> rated;  ///< user and session
  std::string anna, tom;
  const std::string users = "/api/v1/users", sessions = "/api/v1/sessions", login = "/api/v1/login";
};

TEST_F(GateTest, WithoutUsersEverybodyIsAnOperator) {
  EXPECT_TRUE(authorizer.is_open());
  net::Request asked = request("DELETE");
  authorizer.authorize(asked, route_of("DELETE", users + "/{id}"));
  EXPECT_EQ(asked.caller.role, "operator");
  EXPECT_EQ(asked.caller.user_id, "");
  add_users();
  EXPECT_FALSE(authorizer.is_open());
  EXPECT_EQ(refusal(request("DELETE"), users + "/{id}"), 401);
}

TEST_F(GateTest, ARouteForNobodyIsRefusedToAll) {
  const Route forgotten{"GET", "/api/v1/forgotten", 0, not_audited, RequestHandler{}};
  const auto refused = [&](net::Request asked) {
    try {
      authorizer.authorize(asked, forgotten);
      return 0;
    } catch (const net::RequestError& refusal) {
      return refusal.status();
    }
  };
  EXPECT_EQ(refused(request("GET")), 401);
  add_users();
  EXPECT_EQ(refused(with_token("GET", anna)), 403);
}

TEST_F(GateTest, OpenRoutesAskNobody) {
  add_users();
  net::Request page = request("GET");
  page.headers["authorization"] = "Bearer nonsense";
  EXPECT_EQ(refusal(page, "/healthz"), 0);
  EXPECT_EQ(refusal(page, login), 0) << "it finds out itself";
}

TEST_F(GateTest, TellsTheHandlerWhoItIsAndKeepsTheSecretFromIt) {
  add_users();
  net::Request asked = with_cookie("POST", tom);
  authorizer.authorize(asked, route_of("POST", sessions));
  EXPECT_EQ(asked.caller.user_id, tom);
  EXPECT_EQ(asked.caller.name, "tom");
  EXPECT_EQ(asked.caller.role, "trainee");
  EXPECT_FALSE(asked.caller.credential.empty());
  for (const char* header : {"cookie", "authorization", "x-csrf-token"})
    EXPECT_EQ(asked.header(header), "") << header;
}

TEST_F(GateTest, RolesPassAsTheTableSays) {
  add_users();
  EXPECT_EQ(refusal(with_token("GET", anna), users), 0);
  EXPECT_EQ(refusal(with_token("HEAD", anna), users), 0);
  EXPECT_EQ(refusal(with_token("GET", tom), users), 403);
  EXPECT_EQ(refusal(with_token("GET", tom), sessions), 0);
  EXPECT_EQ(refusal(request("GET"), sessions), 401);
}

TEST_F(GateTest, WhatAHiddenSessionMeasuredIsForOperatorsOnly) {
  add_users();
  const std::string one = sessions + "/{id}";
  const auto asked = [&](const std::string& method, const std::string& user) {
    net::Request made = with_token(method, user);
    made.parameters["id"] = "felt2345";
    return made;
  };
  for (const char* part :
       {"/metrics", "/score", "/trace", "/recording", "/session.json", "/mesh", "/snapshot", "/deviation"}) {
    EXPECT_EQ(refusal(asked("GET", tom), one + part), 403) << part;
    EXPECT_EQ(refusal(asked("GET", anna), one + part), 0) << part;
  }
  EXPECT_EQ(refusal(asked("POST", tom), one + "/score/preview"), 403) << "by any rubric";
  for (const char* part : {"/replay", "/exports"})
    EXPECT_EQ(refusal(asked("POST", tom), one + part), 403) << part;
  EXPECT_EQ(refusal(asked("GET", tom), one), 0);
  net::Request replay = asked("GET", tom);
  replay.parameters["id"] = "replay23";
  EXPECT_EQ(refusal(replay, one + "/stream"), 403) << "a replay that an operator made";
  for (const char* part : {"/start", "/pause", "/stop"})
    EXPECT_EQ(refusal(asked("POST", tom), one + part), 0) << part;
}

TEST_F(GateTest, EveryRouteOfASessionIsSaidToShowResultsOrNot) {
  add_users();
  const std::string one = sessions + "/{id}";
  // What neither shows nor changes what a session measured. Who adds a route adds it here or to those that
  // the authorizer hides.
  const std::set<std::string> harmless{"",         "/start",    "/pause",      "/stop",
                                       "/reset",   "/resume",   "/stream",     "/device",
                                       "/restore", "/playback", "/annotations"};
  for (const Route& route : routes()) {
    if (!route.pattern.starts_with(one)) continue;
    const std::string part = route.pattern.substr(one.size());
    net::Request asked = with_token(route.method, tom);
    asked.parameters["id"] = "felt2345";
    if (harmless.contains(part)) continue;
    EXPECT_EQ(refusal(asked, route.pattern), 403) << route.method << ' ' << route.pattern;
  }
}

TEST_F(GateTest, WhoIsNotKnownIsToldHowToBe) {
  add_users();
  const auto challenge = [&](net::Request asked) -> std::string {
    try {
      authorizer.authorize(asked, route_of("GET", users));
    } catch (const net::RequestError& refused) {
      for (const auto& [name, value] : refused.headers())
        if (name == "WWW-Authenticate") return value;
    }
    return "";
  };
  EXPECT_EQ(challenge(request("GET")), "Bearer realm=\"ream\"");
  net::Request bad = request("GET");
  bad.headers["authorization"] = "Bearer nonsense";
  EXPECT_EQ(challenge(bad), "Bearer realm=\"ream\", error=\"invalid_token\"");
  bad.headers["authorization"] = "Basic YTpi";
  EXPECT_EQ(challenge(bad), "Bearer realm=\"ream\", error=\"invalid_request\"");
}

TEST_F(GateTest, TheAuthorizationHeaderIsReadAsRfc6750HasIt) {
  add_users();
  const std::string token = secret(CredentialKind::token, anna).reveal();
  for (const std::string& good : {"Bearer " + token, "bearer " + token, "BEARER   " + token + " "}) {
    net::Request asked = request("GET");
    asked.headers["authorization"] = good;
    EXPECT_EQ(refusal(asked, users), 0) << good.substr(0, 9);
  }
  for (const std::string& bad :
       {token, std::string("Bearer"), std::string("Bearer "), "Bearer" + token,
        "Bearer " + token + ", Bearer " + token, "Token " + token, "Bearer " + token + token}) {
    net::Request asked = request("GET");
    asked.headers["authorization"] = bad;
    EXPECT_EQ(refusal(asked, users), 401) << bad.substr(0, 9);
  }
}

TEST_F(GateTest, ABadTokenIsNotMadeGoodByACookie) {
  add_users();
  net::Request asked = with_cookie("GET", anna);
  EXPECT_EQ(refusal(asked, users), 0);
  asked.headers["authorization"] = "Bearer nonsense";
  EXPECT_EQ(refusal(asked, users), 401);
}

TEST_F(GateTest, ACookiesSecretIsNoTokenAndATokensNoCookie) {
  add_users();
  net::Request asked = request("GET");
  asked.headers["authorization"] = "Bearer " + secret(CredentialKind::cookie, anna).reveal();
  EXPECT_EQ(refusal(asked, users), 401);
  asked = request("GET");
  asked.headers["cookie"] = "ream_session=" + secret(CredentialKind::token, anna).reveal();
  EXPECT_EQ(refusal(asked, users), 401);
  asked.headers["cookie"] = "ream_session=" + secret(CredentialKind::link, anna).reveal();
  EXPECT_EQ(refusal(asked, users), 401);
}

TEST_F(GateTest, ChangesByCookieNeedTheTokenAgainstForgery) {
  add_users();
  net::Request asked = with_cookie("POST", anna);
  EXPECT_EQ(refusal(asked, sessions), 0);
  const std::string good = asked.headers["x-csrf-token"];
  const std::string first = good.front() == 'x' ? "y" : "x";
  for (const std::string& wrong : {std::string(), good + "x", good.substr(1), first + good.substr(1)}) {
    asked.headers["x-csrf-token"] = wrong;
    EXPECT_EQ(refusal(asked, sessions), 403) << wrong;
  }
  asked.headers.erase("x-csrf-token");
  EXPECT_EQ(refusal(asked, sessions), 403);
  asked.method = "GET";
  EXPECT_EQ(refusal(asked, sessions), 0) << "reading does not";
  net::Request other = with_cookie("POST", anna);
  other.headers["x-csrf-token"] = with_cookie("POST", anna).headers["x-csrf-token"];
  EXPECT_EQ(refusal(other, sessions), 403) << "that of another login";
}

TEST_F(GateTest, AWebSocketByCookieSaysItsOrigin) {
  add_users();
  net::Request asked = with_cookie("GET", tom);
  asked.headers["upgrade"] = "websocket";
  asked.parameters["id"] = "toms";
  EXPECT_EQ(refusal(asked, sessions + "/{id}/stream"), 403);
  asked.headers["origin"] = "http://127.0.0.1:8080";
  EXPECT_EQ(refusal(asked, sessions + "/{id}/stream"), 0) << "net has compared it";
  net::Request program = with_token("GET", tom);
  program.headers["upgrade"] = "websocket";
  program.parameters["id"] = "toms";
  EXPECT_EQ(refusal(program, sessions + "/{id}/stream"), 0);
}

TEST_F(GateTest, ARaterSeesSessionsInTheQueueOnly) {
  add_users();
  const std::string ines = add("ines", Role::instructor);
  rated = {{ines, "toms"}};
  for (const auto& [id, status] : {std::pair{"toms", 403}, {"others", 0}}) {
    net::Request asked = with_token("GET", ines);
    asked.parameters["id"] = id;
    EXPECT_EQ(refusal(asked, sessions + "/{id}"), status) << id;
    EXPECT_EQ(refusal(asked, sessions + "/{id}/score"), status) << id;
    net::Request preview = with_token("POST", ines);
    preview.parameters["id"] = id;
    EXPECT_EQ(refusal(preview, sessions + "/{id}/score/preview"), status) << id;
  }
}

TEST_F(GateTest, WhatIsBelowASessionThatOneMayNotSeeDoesNotExist) {
  add_users();
  for (const auto& [id, status] : {std::pair{"toms", 0}, {"others", 404}, {"nothing", 0}}) {
    net::Request asked = with_token("GET", tom);
    asked.parameters["id"] = id;
    EXPECT_EQ(refusal(asked, sessions + "/{id}"), status) << id;
    EXPECT_EQ(refusal(asked, sessions + "/{id}/metrics"), status) << id;
    net::Request by_operator = with_token("GET", anna);
    by_operator.parameters["id"] = id;
    EXPECT_EQ(refusal(by_operator, sessions + "/{id}"), 0) << id;
  }
}

TEST_F(GateTest, GaugesAreForOperatorsTokensAndTheMachineItself) {
  add_users();
  const auto from = [&](const std::string& peer, const std::string& forwarded = {}) {
    net::Request asked = request("GET");
    if (!forwarded.empty()) asked.headers["x-forwarded-for"] = forwarded;
    net::TrustedProxies().resolve(asked, peer, false);
    return refusal(asked, "/metrics");
  };
  for (const char* peer : {"127.0.0.1", "127.9.9.9", "::1", "::ffff:127.0.0.1"})
    EXPECT_EQ(from(peer), 0) << peer;
  for (const char* peer : {"10.0.0.7", "::ffff:10.0.0.7", "", "fe80::1"}) EXPECT_EQ(from(peer), 401) << peer;
  EXPECT_EQ(from("127.0.0.1", "10.0.0.7"), 401) << "a proxy asks for somebody else";
  EXPECT_EQ(refusal(with_token("GET", tom), "/metrics"), 0);
  EXPECT_EQ(refusal(with_cookie("GET", tom), "/metrics"), 403);
  EXPECT_EQ(refusal(with_cookie("GET", anna), "/metrics"), 0);
}

TEST(LoginCookie, IsForThisServerOnly) {
  const access::Secret secret(std::string_view("ream_x"));
  EXPECT_EQ(login_cookie(secret, std::chrono::hours(1), false),
            "ream_session=ream_x; Path=/; HttpOnly; SameSite=Strict; Max-Age=3600");
  EXPECT_EQ(login_cookie(secret, std::chrono::hours(1), true),
            "__Host-ream_session=ream_x; Path=/; HttpOnly; SameSite=Strict; Max-Age=3600; Secure");
  EXPECT_EQ(no_login_cookie(true),
            "__Host-ream_session=; Path=/; HttpOnly; SameSite=Strict; Max-Age=0; Secure");
}

TEST(LoginCookie, IsFoundAmongOthers) {
  const auto found = [](const std::string& header) {
    net::Request request;
    request.headers["cookie"] = header;
    return cookie_of(request).reveal();
  };
  EXPECT_EQ(found("ream_session=a"), "a");
  EXPECT_EQ(found("x=1;ream_session=a;y=2"), "a");
  EXPECT_EQ(found("x=1;  ream_session=a ; y"), "a");
  EXPECT_EQ(found("xream_session=b; ream_session=a"), "a");
  EXPECT_EQ(found("ream_session2=b"), "");
  EXPECT_EQ(found("ream_session"), "");
  EXPECT_EQ(found("ream_session="), "");
  EXPECT_EQ(found(""), "");
  EXPECT_EQ(found(";;; ;"), "");
  EXPECT_EQ(found("ream_session=a=b"), "a=b");
}

}  // namespace
}  // namespace ream::api
