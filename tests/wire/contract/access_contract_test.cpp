#include "access_fixture.hpp"

namespace ream::test {
namespace {

using access::CredentialKind;
using access::Role;

class AccessContractTest : public AccessTest {
 protected:
  void expect(const std::string& method, const std::string& pattern, int status, const Sent& sent = {},
              const std::string& body = {}, const std::string& id = {}) {
    std::string path = pattern;
    if (const size_t at = path.find("{id}"); at != std::string::npos) path.replace(at, 4, id);
    expect_request(method, pattern, path, status, body, sent);
  }

  /// Bodies that no operation with a JSON body takes.
  void refused_bodies(const std::string& method, const std::string& pattern, const Sent& sent,
                      const std::string& good, const std::string& unusable, const std::string& id = {}) {
    expect(method, pattern, 400, sent, "{", id);
    expect(method, pattern, 403, with(sent, "Origin", "http://elsewhere.example"), good, id);
    expect(method, pattern, 413, sent, std::string(options.listen.limits.body_bytes + 1, ' '), id);
    expect(method, pattern, 415, with(sent, "Content-Type", "text/plain"), good, id);
    expect(method, pattern, 422, sent, unusable, id);
  }

  void first_user() {
    expect("GET", login, 200);
    expect("POST", login + "/password", 409, {}, R"({"password": "x", "new_password": "a new password"})");
    expect("POST", tokens, 409, {}, R"({"name": "robot"})");
    expect("POST", links, 409, {}, R"({"name": "for a year"})");
    expect("POST", users, 409, {}, R"({"name": "tom", "role": "trainee", "password": "a good password"})");
    expect("POST", users, 201, {}, R"({"name": "anna", "role": "operator", "password": "password of anna"})");
  }

  void logging_in() {
    const std::string good = R"({"name": "anna", "password": "password of anna"})";
    refused_bodies("POST", login, {}, good, R"({"name": "anna"})");
    expect("POST", login, 200, {}, good);
    anna = page_of("anna");
    expect("GET", login, 200, anna);
    expect("GET", login, 401, {{"Authorization", "Bearer nonsense"}});
    expect("GET", login, 401, {{"Authorization", "Basic YW5uYTpwYXNz"}});
    const Sent other = page_of("anna");
    expect("DELETE", login, 403, without(other, "X-CSRF-Token"));
    expect("DELETE", login, 204, other);
    expect("DELETE", login, 204, other);
    expect("DELETE", login, 401, {{"Authorization", "Bearer nonsense"}});
    const Sent robot = token_of(access_control().users.find_by_name("anna")->id);
    expect("GET", login, 200, robot);
    expect("DELETE", login, 409, robot);
  }

  void changing_users() {
    const std::string tom = R"({"name": "tom", "role": "trainee", "password": "password of tom"})";
    refused_bodies("POST", users, anna, tom, R"({"name": "tom", "role": "king", "password": "7h4-qm2xkd"})");
    expect("POST", users, 401, {}, tom);
    expect("POST", users, 201, anna, tom);
    expect("POST", users, 409, anna, tom);
    tom_id = access_control().users.find_by_name("tom")->id;
    const std::string anna_id = access_control().users.find_by_name("anna")->id;
    trainee = token_of(tom_id);
    expect("GET", users, 200, anna);
    expect("GET", users, 401);
    expect("GET", users, 403, trainee);
    expect("GET", user, 200, anna, "", tom_id);
    expect("GET", user, 401, {}, "", tom_id);
    expect("GET", user, 403, trainee, "", tom_id);
    expect("GET", user, 404, anna, "", "nobody");
    expect("GET", user, 404, anna, "", "%ff%27");
    refused_bodies("PATCH", user, anna, "{}", R"({"enabled": "yes"})", tom_id);
    expect("PATCH", user, 401, {}, "{}", tom_id);
    expect("PATCH", user, 403, trainee, R"({"role": "operator"})", tom_id);
    expect("PATCH", user, 404, anna, "{}", "nobody");
    expect("PATCH", user, 409, anna, R"({"role": "trainee"})", anna_id);
    expect("PATCH", user, 200, anna,
           R"({"display_name": "Tom", "password": "password of tom", "keep_tokens": true})", tom_id);
    expect("DELETE", user, 401, {}, "", tom_id);
    expect("DELETE", user, 403, trainee, "", tom_id);
    expect("DELETE", user, 404, anna, "", "nobody");
    expect("DELETE", user, 409, anna, "", anna_id);
    const std::string gone = add_user("gone", Role::trainee);
    expect("DELETE", user, 204, anna, "", gone);
  }

  void changing_a_password() {
    const std::string path = login + "/password";
    const std::string good = R"({"password": "password of tom", "new_password": "password of tom",
                                 "keep_tokens": true})";
    const Sent page = page_of("tom");
    refused_bodies("POST", path, page, good, R"({"password": "password of tom", "new_password": "short"})");
    expect("POST", path, 401, {}, good);
    expect("POST", path, 204, page, good);
    expect("POST", path, 422, page, R"({"password": "wrong", "new_password": "password of tom"})");
    for (int i = 0; i < 3; ++i)
      request("POST", path, page, R"({"password": "wrong", "new_password": "password of tom"})");
    expect("POST", path, 429, page, good);
  }

  void tokens_and_links() {
    refused_bodies("POST", tokens, anna, R"({"name": "robot"})", R"({"name": ""})");
    expect("POST", tokens, 401, {}, R"({"name": "robot"})");
    expect("POST", tokens, 201, anna,
           R"({"name": "robot", "role": "viewer", "expires_utc": "2026-02-01T00:00:00Z"})");
    expect("GET", tokens, 200, anna);
    expect("GET", tokens, 401);
    const IssuedToken own(request("POST", tokens, trainee, R"({"name": "robot"})"));
    expect("DELETE", token, 401, {}, "", own.id);
    expect("DELETE", token, 403, with(anna, "X-CSRF-Token", "wrong"), "", own.id);
    expect("DELETE", token, 404, anna, "", "nothing");
    expect("DELETE", token, 204, trainee, "", own.id);
    expect("GET", tokens, 403, viewer_of(""));
    refused_bodies("POST", links, anna, "{}", R"({"expires_utc": "2020-01-01T00:00:00Z"})");
    expect("POST", links, 401, {}, "{}");
    expect("POST", links, 404, anna, R"({"session": "nothing"})");
    const std::string session =
        json::parse(request("POST", all, anna, R"({"case": "planned", "script": "demo"})").body).at("id");
    expect("POST", links, 201, anna, json{{"session", session}, {"name", "the visitors"}}.dump());
    expect("GET", links, 200, anna);
    expect("GET", links, 401);
    expect("GET", links, 403, trainee);
    const IssuedToken made(request("POST", links, anna, "{}"));
    expect("DELETE", link, 401, {}, "", made.id);
    expect("DELETE", link, 403, trainee, "", made.id);
    expect("DELETE", link, 404, anna, "", "nothing");
    watching(made.secret);
    expect("DELETE", link, 204, anna, "", made.id);
  }

  void watching(const std::string& secret) {
    const std::string path = login + "/link", good = json{{"secret", secret}}.dump();
    refused_bodies("POST", path, {}, good, "{}");
    expect("POST", path, 200, {}, good);
    expect("POST", path, 401, {}, json{{"secret", secret + "x"}}.dump());
  }

  void audit() {
    expect("GET", "/api/v1/audit", 200, anna);
    expect("GET", "/api/v1/audit", 401);
    expect("GET", "/api/v1/audit", 403, trainee);
    for (const char* query :
         {"?limit=0", "?limit=501", "?limit=many", "?before=-1", "?before=", "?limit=1.5"})
      expect_request("GET", "/api/v1/audit", std::string("/api/v1/audit") + query, 422, "", anna);
  }

  void waiting() {
    for (int i = 0; i < 4; ++i) log_in("anna", "guess");
    expect("POST", login, 429, {}, R"({"name": "anna", "password": "password of anna"})");
    clock.pass(std::chrono::seconds(1));
    expect("POST", login, 401, {}, R"({"name": "anna", "password": "guess"})");
  }

  void a_crowd() {
    options.access.max_hashing = 0;
    start();
    const std::string anna_id = access_control().users.find_by_name("anna")->id;
    const Sent robot = token_of(anna_id);
    expect("POST", users, 429, robot, R"({"name": "ben", "role": "trainee", "password": "password of ben"})");
    expect("PATCH", user, 429, robot, R"({"password": "another password"})", tom_id);
  }

  void while_the_database_is_away() {
    const auto hog = start_without_database();
    const std::string secret = access::make_credential_secret().text.reveal();
    expect("POST", login, 503, {}, R"({"name": "anna", "password": "password of anna"})");
    expect("POST", login + "/link", 503, {}, json{{"secret", secret}}.dump());
    expect("POST", users, 503, {}, R"({"name": "a", "role": "operator", "password": "a good password"})");
    expect("POST", tokens, 503, {}, R"({"name": "robot"})");
    expect("POST", links, 503, {}, "{}");
  }

  struct IssuedToken {
    explicit IssuedToken(const HttpReply& reply) {
      EXPECT_EQ(reply.status, 201) << reply.body;
      id = json::parse(reply.body).at("id");
      secret = json::parse(reply.body).at("secret");
    }
    std::string id, secret;
  };
  Sent viewer_of(const std::string& session) {
    const auto made = issue(CredentialKind::link, {"", {}, "visit", session, ""});
    return page_after(post(login + "/link", json{{"secret", made.secret.reveal()}}.dump()));
  }

  const std::string login = "/api/v1/login", users = "/api/v1/users", user = users + "/{id}",
                    tokens = "/api/v1/tokens", token = tokens + "/{id}", links = "/api/v1/links",
                    link = links + "/{id}";
  Sent anna, trainee;
  std::string tom_id;
};

TEST_F(AccessContractTest, EveryDescribedReplyIsGivenAsDescribed) {
  start();
  first_user();
  logging_in();
  changing_users();
  changing_a_password();
  tokens_and_links();
  audit();
  waiting();
  a_crowd();
  while_the_database_is_away();
  expect_all_given({"access"});
}

class AccessBodiesTest : public AccessTest {
 protected:
  /// What the schema takes is taken (`taken`), all else is refused with 422.
  void expect_as_the_schema(const std::string& schema, const std::string& method, const std::string& path,
                            int taken, const std::vector<std::string>& bodies) {
    const json& described = contract.at("components").at("schemas").at(schema);
    for (const std::string& body : bodies) {
      const bool fits = faults(described, json::parse(body)).empty();
      const HttpReply reply = request(method, path, anna, body);
      EXPECT_EQ(reply.status, fits ? taken : 422) << schema << ' ' << body << '\n' << reply.body;
    }
  }
  void SetUp() override {
    start();
    anna_id = add_user("anna", Role::operator_);
    anna = token_of(anna_id);
  }
  std::string anna_id;
  Sent anna;
};

TEST_F(AccessBodiesTest, NewUsersAreTakenAsTheSchemaSays) {
  const auto of_length = [](size_t length) {
    std::string text;
    while (text.size() < length) text += "a good sentence, ";
    return text.substr(0, length);
  };
  const auto named = [](const std::string& name) {
    return json{{"name", name}, {"role", "trainee"}, {"password", "7h4-qm2xkd"}}.dump();
  };
  expect_as_the_schema(
      "NewUser", "POST", "/api/v1/users", 201,
      {named("ben"),
       named("Ben.Upper@example-1_x"),
       named(""),
       named("two words"),
       named("b\u00e4n"),
       named(std::string(64, 'b')),
       named(std::string(65, 'b')),
       named("../x"),
       "{}",
       "[]",
       R"({"name": "c1", "role": "viewer", "password": "7h4-qm2xkd"})",
       R"({"name": "c2", "role": "operator", "password": "012345678"})",
       R"({"name": "c3", "role": "instructor", "password": "7h4-qm2xkd", "display_name": "Dr. C\u00e4sar"})",
       R"({"name": "c4", "role": "trainee", "password": "7h4-qm2xkd", "display_name": ""})",
       R"({"name": "c5", "role": "trainee", "password": "7h4-qm2xkd", "display_name": "two\nlines"})",
       R"({"name": "c6", "role": "trainee", "password": "7h4-qm2xkd", "display_name": "a\u0000b"})",
       R"({"name": "c7", "role": "trainee", "password": 123456789012})",
       R"({"name": "c8", "role": "trainee", "password": "7h4-qm2xkd", "id": "x"})",
       json{{"name", "c9"}, {"role", "trainee"}, {"password", of_length(1000)}}.dump(),
       json{{"name", "d1"}, {"role", "trainee"}, {"password", of_length(1001)}}.dump(),
       json{{"name", "d2"},
            {"role", "trainee"},
            {"password", "7h4-qm2xkd"},
            {"display_name", std::string(100, 'd')}}
           .dump(),
       json{{"name", "d3"},
            {"role", "trainee"},
            {"password", "7h4-qm2xkd"},
            {"display_name", std::string(101, 'd')}}
           .dump()});
}

TEST_F(AccessBodiesTest, ChangesOfUsersAreTakenAsTheSchemaSays) {
  const std::string tom = add_user("tom", Role::trainee);
  expect_as_the_schema(
      "UserChange", "PATCH", "/api/v1/users/" + tom, 200,
      {"{}", "[]", R"({"display_name": "Tom"})", R"({"display_name": ""})", R"({"display_name": null})",
       R"({"display_name": "two\nlines"})", R"({"role": "instructor"})", R"({"role": "viewer"})",
       R"({"role": ""})", R"({"enabled": false})", R"({"enabled": 0})", R"({"keep_tokens": true})",
       R"({"keep_tokens": 1})", R"({"password": "short"})", R"({"password": "long enough"})",
       R"({"password": null})", R"({"name": "tim"})"});
}

TEST_F(AccessBodiesTest, TokensAndLinksAreTakenAsTheSchemaSays) {
  const std::string session =
      json::parse(request("POST", all, anna, R"({"case": "planned", "script": "demo"})").body).at("id");
  expect_as_the_schema(
      "NewToken", "POST", "/api/v1/tokens", 201,
      {R"({"name": "robot"})", R"({"name": ""})", "{}", R"({"name": "two\nlines"})",
       R"({"name": "r", "role": "viewer"})", R"({"name": "r", "role": "king"})",
       R"({"name": "r", "role": null})", R"({"name": "r", "expires_utc": "2026-02-03T00:00:00Z"})",
       R"({"name": "r", "expires_utc": "2026-02-03"})", R"({"name": "r", "expires_utc": 5})",
       R"({"name": "r", "user_id": "x"})"});
  expect_as_the_schema("NewLink", "POST", "/api/v1/links", 201,
                       {"{}", R"({"name": "visitors"})", R"({"name": "two\nlines"})", R"({"session": null})",
                        R"({"session": "../x"})", json{{"session", session}}.dump(),
                        R"({"expires_utc": "2026-02-03T00:00:00Z"})", R"({"expires_utc": "soon"})",
                        R"({"role": "operator"})"});
}

}  // namespace
}  // namespace ream::test
