#include <thread>

#include "support/test_certificate.hpp"
#include "support/tls_socket.hpp"
#include "wire/access/personas.hpp"

namespace ream::test {
namespace {

using access::CredentialKind;
using access::Role;

void expect_sent_away(RawWebSocket& viewer) {
  RawWebSocket::Message message = viewer.receive();
  while (!message.close_code()) message = viewer.receive();
  EXPECT_EQ(message.close_code(), 4003);
  EXPECT_EQ(message.payload.substr(2), "access has ended; log in again");
}

/// A server without users.
class OpenBeginningTest : public AccessTest {};

TEST_F(OpenBeginningTest, WhatWasOpenedThenEndsWithTheFirstUser) {
  start();
  const json made = json::parse(request("POST", all, {}, R"({"case": "planned", "script": "demo"})").body);
  RawWebSocket events(server->port(), "/api/v1/events", {}),
      viewer(server->port(), all + "/" + made.at("id").get<std::string>() + "/stream", {});
  EXPECT_EQ(request("POST", "/api/v1/links", {}, R"({"name": "for a year"})").status, 409);
  EXPECT_EQ(request("POST", "/api/v1/users", {},
                    R"({"name": "anna", "role": "operator", "password": "password of anna"})")
                .status,
            201);
  expect_sent_away(events);
  expect_sent_away(viewer);
  EXPECT_EQ(request("GET", all).status, 401);
}

class LoginTest : public PersonaTest {
 protected:
  /// Who the server takes that for; empty: nobody.
  std::string role_of(const Sent& sent) {
    const HttpReply reply = request("GET", "/api/v1/login", sent);
    EXPECT_EQ(reply.status, 200) << reply.body;
    const json role = json::parse(reply.body).at("role");
    return role.is_null() ? "" : role.get<std::string>();
  }
  std::string session_of_tom() { return scene_for(one).session; }
  std::string origin() const { return "http://127.0.0.1:" + std::to_string(server->port()); }
  RawWebSocket watch(const std::string& session, const Sent& sent) {
    return RawWebSocket(server->port(), all + "/" + session + "/stream", sent);
  }
};

TEST_F(LoginTest, GivesAPageACookieThatItsScriptsCannotRead) {
  const HttpReply reply = log_in("tom", "password of tom");
  ASSERT_EQ(reply.status, 200) << reply.body;
  const std::string& cookie = reply.headers.at("set-cookie");
  EXPECT_EQ(cookie.rfind("ream_session=ream_", 0), 0u);
  for (const char* flag : {"; HttpOnly", "; SameSite=Strict", "; Path=/", "; Max-Age=86400"})
    EXPECT_NE(cookie.find(flag), std::string::npos) << cookie.substr(90);
  EXPECT_EQ(cookie.find("Secure"), std::string::npos) << "without TLS";
  const json who = json::parse(reply.body);
  EXPECT_EQ(who.at("role"), "trainee");
  EXPECT_EQ(who.at("user").at("id"), tom_id);
  EXPECT_EQ(reply.body.find("ream_"), std::string::npos) << "the secret is in the cookie only";
  EXPECT_EQ(reply.headers.at("cache-control"), "no-store");
}

TEST_F(LoginTest, OverTlsItsCookieNeverLeavesTls) {
  net::TlsOptions files{folder.path() / "chain.pem", folder.path() / "key.pem"};
  make_certificate(files.certificate_chain, files.key);
  options.listen.tls = files;
  start();
  TlsSocket socket(server->port());
  const std::string body = R"({"name": "tom", "password": "password of tom"})";
  socket.send(
      "POST /api/v1/login HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/json\r\nContent-Length: " +
      std::to_string(body.size()) + "\r\n\r\n" + body);
  const HttpReply reply = receive_reply(socket);
  EXPECT_EQ(reply.status, 200) << reply.body;
  EXPECT_TRUE(reply.headers.at("set-cookie").starts_with("__Host-ream_session="));
  EXPECT_TRUE(reply.headers.at("set-cookie").ends_with("; Secure"));
}

TEST_F(LoginTest, LastsUntilTheLogout) {
  const Sent page = page_of("tom");
  EXPECT_EQ(role_of(page), "trainee");
  EXPECT_EQ(request("POST", all, page, R"({"case": "planned", "script": "demo"})").status, 201);
  EXPECT_EQ(request("DELETE", "/api/v1/login", without(page, "X-CSRF-Token")).status, 403);
  const HttpReply out = request("DELETE", "/api/v1/login", page);
  EXPECT_EQ(out.status, 204);
  EXPECT_NE(out.headers.at("set-cookie").find("ream_session=; "), std::string::npos);
  EXPECT_NE(out.headers.at("set-cookie").find("Max-Age=0"), std::string::npos);
  EXPECT_EQ(role_of(page), "");
  EXPECT_EQ(request("GET", all, page).status, 401);
}

TEST_F(LoginTest, EndsByItselfWhenNobodyUsesItAndAfterADay) {
  const Sent idle = page_of("tom"), busy = page_of("tom");
  for (int hour = 1; hour <= 23; ++hour) {
    clock.pass(std::chrono::hours(1));
    EXPECT_EQ(role_of(busy), "trainee") << hour;
  }
  EXPECT_EQ(role_of(idle), "");
  clock.pass(std::chrono::hours(1));
  EXPECT_EQ(role_of(busy), "");
}

TEST_F(LoginTest, WrongNamesAndWrongPasswordsLookTheSame) {
  const HttpReply wrong = log_in("tom", "guess"), unknown = log_in("nobody", "guess"),
                  disabled = log_in("dora", "password of dora");
  EXPECT_EQ(wrong.status, 401);
  EXPECT_EQ(wrong.body, unknown.body);
  EXPECT_EQ(wrong.body, disabled.body);
  EXPECT_EQ(wrong.headers.count("set-cookie"), 0u);
  for (const char* name : {"tom", "nobody"}) {
    for (int i = 0; i < 3; ++i) EXPECT_EQ(log_in(name, "guess").status, 401) << name;
    const HttpReply wait = log_in(name, "guess");
    EXPECT_EQ(wait.status, 429) << name;
    EXPECT_EQ(wait.headers.at("retry-after"), "1") << name;
  }
}

TEST_F(LoginTest, WaitsGrowAndPassAndTheRightPasswordDoesNotJumpThem) {
  for (int i = 0; i < 4; ++i) EXPECT_EQ(log_in("tom", "guess").status, 401);
  for (const char* seconds : {"1", "2", "4", "8"}) {
    const HttpReply wait = log_in("tom", "password of tom");
    EXPECT_EQ(wait.status, 429);
    EXPECT_EQ(wait.headers.at("retry-after"), seconds);
    clock.pass(std::chrono::seconds(std::stoi(seconds)));
    EXPECT_EQ(log_in("tom", "guess").status, 401);
  }
  clock.pass(std::chrono::seconds(16));
  EXPECT_EQ(log_in("tom", "password of tom").status, 200);
  EXPECT_EQ(log_in("tom", "guess").status, 401) << "forgiven";
}

TEST_F(LoginTest, GuessingAtOneKeepsNobodyElseOut) {
  EXPECT_EQ(log_in("tess", "password of tess").status, 200);
  for (int i = 0; i < 60; ++i) log_in("tom" + std::to_string(i), "guess");
  for (int i = 0; i < 10; ++i) log_in("tom", "guess");
  EXPECT_EQ(log_in("tom", "password of tom").status, 429);
  EXPECT_EQ(log_in("tess", "password of tess").status, 200) << "has been here before";
}

TEST_F(LoginTest, AViewerLinkLetsWatchAndNoMore) {
  const std::string shown = session_of_tom(), other = session_of_tom();
  const HttpReply made = request("POST", "/api/v1/links", page_of("ina"), json{{"session", shown}}.dump());
  ASSERT_EQ(made.status, 201) << made.body;
  const std::string secret = json::parse(made.body).at("secret");
  const HttpReply reply = post("/api/v1/login/link", json{{"secret", secret}}.dump());
  ASSERT_EQ(reply.status, 200) << reply.body;
  EXPECT_EQ(json::parse(reply.body).at("only_session"), shown);
  EXPECT_EQ(json::parse(reply.body).at("user"), nullptr);
  const Sent guest = page_after(reply);
  EXPECT_EQ(request("GET", all + "/" + shown, guest).status, 200);
  EXPECT_EQ(request("GET", all + "/" + other, guest).status, 404);
  EXPECT_EQ(request("POST", all + "/" + shown + "/start", guest).status, 403);
  EXPECT_EQ(request("GET", "/api/v1/cases", guest).status, 403);
  EXPECT_EQ(request("GET", "/api/v1/users", guest).status, 403);
  const json list = json::parse(request("GET", all, guest).body).at("sessions");
  ASSERT_EQ(list.size(), 1u) << list;
  EXPECT_EQ(list[0].at("id"), shown);
  EXPECT_EQ(request("GET", all, {{"Authorization", "Bearer " + secret}}).status, 401) << "a link is no token";
}

TEST_F(LoginTest, ListsShowTraineesTheirOwn) {
  const std::string toms = session_of_tom();
  const HttpReply of_tess =
      request("POST", all, token_of(tess_id), R"({"case": "planned", "script": "demo"})");
  const std::string tesses = json::parse(of_tess.body).at("id");
  const auto ids = [&](const Sent& sent) {
    std::set<std::string> found;
    const json list = json::parse(request("GET", all, sent).body);
    for (const json& session : list.at("sessions")) found.insert(session.at("id"));
    return found;
  };
  EXPECT_EQ(ids(token_of(tom_id)), std::set<std::string>{toms});
  EXPECT_EQ(ids(token_of(tess_id)), std::set<std::string>{tesses});
  EXPECT_EQ(ids(token_of(instructor_id)), (std::set<std::string>{toms, tesses}));
  EXPECT_EQ(ids(guest_of("")), (std::set<std::string>{toms, tesses}));
  const json unseen = json::parse(request("GET", all + "/" + tesses, token_of(tom_id)).body);
  const json unknown = json::parse(request("GET", all + "/abcdefgh", token_of(tom_id)).body);
  EXPECT_EQ(unseen.at("detail"), "no session '" + tesses + "'");
  EXPECT_EQ(unknown.at("detail"), "no session 'abcdefgh'");
}

TEST_F(LoginTest, ARemarkIsSignedByWhoMadeIt) {
  const std::string session = all + "/" + session_of_tom(), remarks = session + "/annotations";
  ASSERT_EQ(request("POST", session + "/start", token_of(tom_id)).status, 200);
  for (const char* signed_as : {R"({"words": "ease off"})", R"({"words": "ease off", "author": "tom"})"}) {
    const HttpReply made = request("POST", remarks, token_of(instructor_id), signed_as);
    ASSERT_EQ(made.status, 201) << made.body;
    EXPECT_EQ(json::parse(made.body).at("author"), "ina");
  }
}

TEST_F(LoginTest, StreamsAreForPagesOfThisServerAndForTokens) {
  const std::string session = session_of_tom();
  const Sent page = page_of("tom");
  EXPECT_EQ(watch(session, {}).handshake().status, 401);
  EXPECT_EQ(watch(session, page).handshake().status, 403) << "a cookie without an origin";
  EXPECT_EQ(watch(session, with(page, "Origin", "https://elsewhere.example")).handshake().status, 403);
  EXPECT_EQ(watch(session, with(page, "Origin", "null")).handshake().status, 403);
  EXPECT_EQ(watch(session, with(page, "Origin", origin())).handshake().status, 101);
  EXPECT_EQ(watch(session, token_of(tom_id)).handshake().status, 101);
  EXPECT_EQ(watch(session, token_of(tess_id)).handshake().status, 404);
  const std::string secret = token_of(tom_id).at("Authorization").substr(7);
  for (const char* key : {"token", "access_token", "authorization"})
    EXPECT_EQ(RawWebSocket(server->port(), all + "/" + session + "/stream?" + key + "=" + secret)
                  .handshake()
                  .status,
              401)
        << "never in the address";
}

TEST_F(LoginTest, RevokedTokensAndEndedLoginsCloseTheirStreams) {
  const std::string session = session_of_tom();
  const auto token = issue(CredentialKind::token, {tom_id, {}, "", "", ""});
  const Sent page = page_of("tom");
  RawWebSocket by_token = watch(session, bearer(token)),
               by_page = watch(session, with(page, "Origin", origin())),
               of_another = watch(session, token_of(instructor_id));
  for (RawWebSocket* viewer : {&by_token, &by_page, &of_another})
    EXPECT_EQ(viewer->receive().payload, "hello " + session);
  EXPECT_EQ(request("DELETE", "/api/v1/tokens/" + token.row.id, page).status, 204);
  expect_sent_away(by_token);
  EXPECT_EQ(request("DELETE", "/api/v1/login", page).status, 204);
  expect_sent_away(by_page);
  of_another.send_binary("still here");
  EXPECT_EQ(of_another.receive().payload, "still here");
}

TEST_F(LoginTest, WithdrawnLinksAndLostRolesCloseTheirStreams) {
  const std::string session = session_of_tom();
  const auto link = issue(CredentialKind::link, {instructor_id, {}, "", session, ""});
  const auto guest = issue(CredentialKind::cookie, {"", {}, "", session, "", link.row.id});
  RawWebSocket watching = watch(session, with(page_with(guest), "Origin", origin()));
  RawWebSocket teaching = watch(session, token_of(instructor_id));
  EXPECT_EQ(watching.receive().payload, "hello " + session);
  EXPECT_EQ(teaching.receive().payload, "hello " + session);
  EXPECT_EQ(
      request("PATCH", "/api/v1/users/" + instructor_id, page_of("olga"), R"({"role": "trainee"})").status,
      200);
  expect_sent_away(teaching);
  expect_sent_away(watching);
  EXPECT_EQ(request("GET", all + "/" + session, page_with(guest)).status, 401);
}

TEST_F(LoginTest, AStreamEndsWithItsCredential) {
  const std::string session = session_of_tom();
  const std::string soon = utc_text(clock.function()() + std::chrono::minutes(5));
  RawWebSocket viewer = watch(session, bearer(issue(CredentialKind::token, {tom_id, {}, "", "", soon})));
  EXPECT_EQ(viewer.receive().payload, "hello " + session);
  clock.pass(std::chrono::minutes(6));
  expect_sent_away(viewer);
}

TEST_F(LoginTest, WatchingKeepsALoginAlive) {
  const std::string session = session_of_tom();
  const Sent page = page_of("tom");
  RawWebSocket viewer = watch(session, with(page, "Origin", origin()));
  EXPECT_EQ(viewer.receive().payload, "hello " + session);
  for (int i = 0; i < 2; ++i) {
    clock.pass(std::chrono::minutes(100));
    const std::string now = utc_text(clock.function()());
    for (int tries = 0; tries < 1000; ++tries) {
      const auto rows = access_control().credentials.list(CredentialKind::cookie, tom_id);
      if (!rows.empty() && rows[0].last_used_utc == now) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  viewer.send_binary("still here");
  EXPECT_EQ(viewer.receive().payload, "still here");
}

TEST_F(LoginTest, ATokenMakesNoWiderOne) {
  const Sent narrow = token_of(operator_id, Role::trainee);
  EXPECT_EQ(request("POST", "/api/v1/tokens", narrow, R"({"name": "x", "role": "operator"})").status, 422);
  const json made = json::parse(request("POST", "/api/v1/tokens", narrow, R"({"name": "x"})").body);
  EXPECT_EQ(made.at("role"), "trainee");
  const auto short_lived = issue(CredentialKind::token, {operator_id, {}, "", "", "2026-02-01T00:00:00Z"});
  for (const char* body : {R"({"name": "x"})", R"({"name": "x", "expires_utc": "2026-05-01T00:00:00Z"})"})
    EXPECT_EQ(
        json::parse(request("POST", "/api/v1/tokens", bearer(short_lived), body).body).at("expires_utc"),
        "2026-02-01T00:00:00Z");
  EXPECT_EQ(request("POST", "/api/v1/tokens", token_of(tom_id), R"({"name": "x", "role": "viewer"})").status,
            422)
      << "viewers see the sessions of all";
}

TEST_F(LoginTest, PeopleHaveToDoWithTheirOwnTokensAndLinks) {
  const auto of_tom = issue(CredentialKind::token, {tom_id, {}, "toms", "", ""});
  const auto of_olga = issue(CredentialKind::link, {operator_id, {}, "olgas", "", ""});
  const auto names = [&](const std::string& path, const std::string& what, const Sent& sent) {
    std::set<std::string> found;
    const json reply = json::parse(request("GET", path, sent).body);
    for (const json& row : reply.at(what)) {
      found.insert(row.at("name"));
      EXPECT_FALSE(row.contains("secret") || row.contains("hash")) << row;
    }
    return found;
  };
  EXPECT_EQ(names("/api/v1/tokens", "tokens", page_of("tom")), std::set<std::string>{"toms"});
  EXPECT_EQ(names("/api/v1/tokens?user_id=" + tom_id, "tokens", page_of("tess")), std::set<std::string>{});
  EXPECT_TRUE(names("/api/v1/tokens", "tokens", page_of("olga")).contains("toms"));
  EXPECT_EQ(names("/api/v1/tokens?user_id=" + tess_id, "tokens", page_of("olga")), std::set<std::string>{});
  EXPECT_EQ(names("/api/v1/links", "links", page_of("ina")), std::set<std::string>{});
  EXPECT_EQ(names("/api/v1/links", "links", page_of("olga")), std::set<std::string>{"olgas"});
  EXPECT_EQ(request("DELETE", "/api/v1/tokens/" + of_tom.row.id, page_of("tess")).status, 404);
  EXPECT_EQ(request("DELETE", "/api/v1/links/" + of_olga.row.id, page_of("ina")).status, 404);
  EXPECT_EQ(request("DELETE", "/api/v1/links/" + of_tom.row.id, page_of("olga")).status, 404) << "a token";
  EXPECT_EQ(request("DELETE", "/api/v1/tokens/" + of_tom.row.id, page_of("olga")).status, 204);
}

TEST_F(LoginTest, TheAuditLogTellsWhatHasHappenedNewestFirst) {
  const Sent olga = page_of("olga");
  log_in("tom", "guess");
  log_in("my-password-in-the-wrong-field", "guess");
  const json ben = json::parse(request("POST", "/api/v1/users", olga,
                                       R"({"name": "ben", "role": "trainee", "password": "password of ben"})")
                                   .body);
  request("PATCH", "/api/v1/users/" + ben.at("id").get<std::string>(), olga, R"({"role": "instructor"})");
  request("DELETE", "/api/v1/users/" + ben.at("id").get<std::string>(), olga);
  json entries = json::array();
  json next = nullptr;
  int pages = 0;
  do {
    const std::string before = next.is_null() ? "" : "&before=" + next.dump();
    const json page = json::parse(request("GET", "/api/v1/audit?limit=2" + before, olga).body);
    EXPECT_LE(page.at("entries").size(), 2u);
    for (const json& entry : page.at("entries")) entries.push_back(entry);
    next = page.at("next");
    ++pages;
  } while (!next.is_null() && pages < 20);
  std::vector<std::string> actions;
  for (const json& entry : entries) actions.push_back(entry.at("action"));
  EXPECT_EQ(actions, (std::vector<std::string>{"user.remove", "user.change", "user.add", "login.failed",
                                               "login.failed", "login"}));
  EXPECT_EQ(entries[0].at("name"), "olga");
  EXPECT_EQ(entries[0].at("address"), "127.0.0.1");
  EXPECT_EQ(entries[1].at("detail"), "ben: role instructor");
  EXPECT_EQ(entries[3].at("object"), "") << "what was typed in vain is not kept";
  EXPECT_EQ(entries[4].at("object"), tom_id);
  EXPECT_EQ(entries.dump().find("wrong-field"), std::string::npos);
}

TEST_F(LoginTest, DeletedDataIsInTheAuditLog) {
  const Sent olga = page_of("olga");
  const std::string session = session_of_tom();
  EXPECT_EQ(request("DELETE", "/api/v1/cases/planned", olga).status, 409) << "refused: not in the log";
  EXPECT_EQ(request("DELETE", "/api/v1/cases/unplanned", olga).status, 204);
  const json entries = json::parse(request("GET", "/api/v1/audit?limit=2", olga).body).at("entries");
  EXPECT_EQ(entries[0].at("action"), "case.delete");
  EXPECT_EQ(entries[0].at("object"), "unplanned");
  EXPECT_EQ(entries[0].at("user_id"), operator_id);
  EXPECT_EQ(entries[1].at("action"), "login");
}

}  // namespace
}  // namespace ream::test
