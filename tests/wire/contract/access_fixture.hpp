#pragma once
#include "support/database_hog.hpp"
#include "support/hand_clock.hpp"
#include "wire/contract/contract_fixture.hpp"

namespace ream::test {

/// A server whose clock goes by hand. Everybody's password is "password of <name>".
class AccessTest : public ContractTest {
 protected:
  using Sent = std::map<std::string, std::string>;

  AccessTest() {
    options.access.now = clock.function();
    options.access.cost = {1, size_t{8} << 10};
  }

  access::AccessControl& access_control() { return server->access_control(); }

  /// Id of a new user.
  std::string add_user(const std::string& name, access::Role role) {
    return access_control().users.add({name, "", role, access::Secret("password of " + name)}).id;
  }
  access::IssuedCredential issue(access::CredentialKind kind, const access::NewCredential& wanted) {
    return access_control().credentials.issue(kind, wanted);
  }
  /// What a program of that user sends.
  Sent token_of(const std::string& user_id, std::optional<access::Role> limit = std::nullopt) {
    return bearer(issue(access::CredentialKind::token, {user_id, limit, "a test", "", ""}));
  }
  static Sent bearer(const access::IssuedCredential& token) {
    return {{"Authorization", "Bearer " + token.secret.reveal()}};
  }

  /// A server whose database can be asked nothing as long as the hog lives.
  std::unique_ptr<DatabaseHog> start_without_database() {
    options.database = std::make_shared<store::Database>(
        database_url(), store::DatabaseLimits{.connections = 1, .timeout = std::chrono::milliseconds(50)});
    start();
    return std::make_unique<DatabaseHog>(*options.database);
  }

  HttpReply log_in(const std::string& name, const std::string& password) {
    return post("/api/v1/login", json{{"name", name}, {"password", password}}.dump());
  }
  /// What a page sends after that reply to a login, with every change.
  static Sent page_after(const HttpReply& login) {
    const std::string& cookie = login.headers.at("set-cookie");
    return {{"Cookie", cookie.substr(0, cookie.find(';'))},
            {"X-CSRF-Token", json::parse(login.body).at("csrf_token").get<std::string>()}};
  }
  /// What the page of a user sends.
  Sent page_of(const std::string& name) {
    const HttpReply reply = log_in(name, "password of " + name);
    EXPECT_EQ(reply.status, 200) << reply.body;
    return page_after(reply);
  }

  HttpReply request(const std::string& method, const std::string& path, const Sent& sent = {},
                    const std::string& body = {}) {
    return http_request(server->port(), method, path, body, sent);
  }
  static Sent with(Sent sent, const std::string& name, const std::string& value) {
    sent[name] = value;
    return sent;
  }
  static Sent without(Sent sent, const std::string& name) {
    sent.erase(name);
    return sent;
  }

  HandClock clock;
};

}  // namespace ream::test
