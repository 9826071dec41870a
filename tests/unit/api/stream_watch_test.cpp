#include "api/stream_watch.hpp"

#include <atomic>
#include <thread>

#include "access/access_control.hpp"
#include "support/fake_session.hpp"
#include "support/test_databases.hpp"

namespace ream::api {
namespace {

using access::CredentialKind;

bool has_ended(net::WebSocketSession& session) {
  const auto close_reason = session.close_reason();
  if (!close_reason) return false;
  EXPECT_EQ(close_reason->code, StreamWatch::access_ended);
  EXPECT_EQ(session.next(), std::nullopt) << "not a word more";
  return true;
}

void until_ended(net::WebSocketSession& session) {
  for (int i = 0; i < 1000 && !has_ended(session); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(has_ended(session));
}

class StreamWatchTest : public test::TestDatabase<test::OnSqlite> {
 protected:
  StreamWatchTest() {
    users.add({"u1", "anna", "Anna", "operator", "2026-01-31T12:00:00Z", "hash", true});
    users.add({"u2", "tom", "Tom", "instructor", "2026-01-31T12:00:00Z", "hash", true});
    token = credentials.issue(CredentialKind::token, {"u2", {}, "", "", ""}).row.id;
  }
  std::unique_ptr<net::WebSocketSession> open(const std::string& credential) {
    net::Request request;
    request.caller = {"u2", "Tom", credential.empty() ? "operator" : "instructor", "", credential};
    auto session = watch.watched(request, std::make_unique<test::FakeViewer>("s1"));
    session->on_open([this] { ++woken; });
    return session;
  }
  store::UserTable users{this->database(), "operator"};
  access::AccessControl access_control{this->database()};
  access::Credentials& credentials = access_control.credentials;
  std::string token;
  std::atomic<int> woken{0};
  StreamWatch watch{access_control, std::chrono::milliseconds(20)};
};

/// A server without users.
class OpenStreamWatchTest : public test::TestDatabase<test::OnSqlite> {
 protected:
  std::unique_ptr<net::WebSocketSession> open() {
    net::Request request;
    request.caller = {"", "", "operator", "", ""};
    auto session = watch.watched(request, std::make_unique<test::FakeViewer>("s1"));
    session->on_open([this] { ++woken; });
    return session;
  }
  static void add_anna(access::AccessControl& to) {
    to.users.add({"anna", "", access::Role::operator_, access::Secret(std::string_view("password of anna"))});
  }
  access::AccessOptions cheap() {
    access::AccessOptions options;
    options.cost = {1, size_t{8} << 10};
    return options;
  }
  access::AccessControl access_control{this->database(), cheap()};
  std::atomic<int> woken{0};
  StreamWatch watch{access_control, std::chrono::milliseconds(20)};
};

TEST_F(StreamWatchTest, LetsGoodOnesTalk) {
  const auto session = open(token);
  EXPECT_FALSE(has_ended(*session));
  EXPECT_TRUE(session->next());
  const std::string text = "echo";
  session->on_message(std::as_bytes(std::span(text.data(), text.size())));
  EXPECT_TRUE(session->next());
  session->on_close();
}

TEST_F(StreamWatchTest, RevocationEndsThemAtOnce) {
  const std::string other = credentials.issue(CredentialKind::token, {"u2", {}, "", "", ""}).row.id;
  const auto session = open(token), others = open(other);
  woken = 0;
  credentials.revoke(token);
  EXPECT_EQ(woken, 1);
  EXPECT_TRUE(has_ended(*session));
  const std::string text = "more force";
  session->on_message(std::as_bytes(std::span(text.data(), text.size())));
  EXPECT_EQ(woken, 1) << "what it still says is not heard";
  EXPECT_FALSE(has_ended(*others));
  session->on_close();
  others->on_close();
}

TEST_F(StreamWatchTest, OneThatWasRevokedOnTheWayInIsNotLetIn) {
  credentials.revoke(token);
  EXPECT_TRUE(has_ended(*open(token)));
  EXPECT_TRUE(has_ended(*open(""))) << "there are users";
}

TEST_F(StreamWatchTest, AnotherProcessEndsThemWithinSeconds) {
  const auto session = open(token);
  const auto again = open_again();
  access::Credentials other(*again);
  other.revoke(token);
  until_ended(*session);
}

TEST_F(StreamWatchTest, AnotherRoleEndsThem) {
  const auto session = open(token);
  users.change("u2", [](store::UserRow& row) { row.role = "trainee"; });
  until_ended(*session);
}

TEST_F(StreamWatchTest, OnesThatHaveClosedAreNotWoken) {
  const auto session = open(token);
  session->on_close();
  woken = 0;
  credentials.revoke(token);
  EXPECT_EQ(woken, 0);
}

TEST_F(OpenStreamWatchTest, WhatWasOpenedBeforeTheFirstUserEndsWithThatUser) {
  const auto viewer = open(), device = open();
  EXPECT_FALSE(has_ended(*viewer));
  woken = 0;
  add_anna(access_control);
  EXPECT_EQ(woken, 2) << "at once";
  EXPECT_TRUE(has_ended(*viewer));
  EXPECT_TRUE(has_ended(*device));
  EXPECT_TRUE(has_ended(*open())) << "was let in before and is slow";
  viewer->on_close();
  device->on_close();
}

TEST_F(OpenStreamWatchTest, AlsoWhenAnotherProcessAddsThatUser) {
  const auto viewer = open();
  const auto again = open_again();
  access::AccessControl other(*again, cheap());
  add_anna(other);
  until_ended(*viewer);
}

}  // namespace
}  // namespace ream::api
