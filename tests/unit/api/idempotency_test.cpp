#include "api/idempotency.hpp"

#include <gtest/gtest.h>

#include <future>
#include <latch>

#include "net/problem.hpp"
#include "support/expect_error.hpp"
#include "support/test_databases.hpp"

namespace ream::api {
namespace {

class IdempotencyTest : public test::TestDatabase<test::OnSqlite> {
 protected:
  IdempotencyTest() { open(); }
  void open() {
    idempotency = std::make_unique<Idempotency>(database(), [this] { return now; });
  }
  static net::Request request(const std::string& key, const std::string& body = "{}",
                              const std::string& user = {}) {
    net::Request made;
    made.method = "POST";
    made.path = "/things";
    made.body = body;
    made.caller.user_id = user;
    if (!key.empty()) made.headers["idempotency-key"] = key;
    return made;
  }
  net::Response ask(const net::Request& asked, int status = 201) {
    return idempotency->answer(asked, [&](const net::Request&) {
      ++made;
      net::Response response = net::bytes_response(status, "application/json",
                                                   net::share("{\"n\": " + std::to_string(made) + "}"));
      response.headers.emplace_back("Location", "/things/" + std::to_string(made));
      return response;
    });
  }
  int status_of(const net::Request& asked) {
    try {
      return ask(asked).status;
    } catch (const net::RequestError& refusal) {
      return refusal.status();
    }
  }
  static std::string text(const net::Response& response) {
    return {reinterpret_cast<const char*>(response.body->data()), response.body->size()};
  }

  UtcMoment now = utc_moment("2026-01-31T12:00:00Z");
  std::unique_ptr<Idempotency> idempotency;
  int made = 0;
};

TEST_F(IdempotencyTest, TheSameRequestIsMadeOnceAndAnsweredTheSame) {
  const net::Response first = ask(request("k1")), again = ask(request("k1"));
  EXPECT_EQ(made, 1);
  EXPECT_EQ(again.status, 201);
  EXPECT_EQ(text(again), text(first));
  EXPECT_EQ(again.content_type, "application/json");
  EXPECT_EQ(again.header("Location"), "/things/1");
  EXPECT_EQ(again.header("Idempotency-Replayed"), "true");
  EXPECT_EQ(first.header("Idempotency-Replayed"), "");
  ask(request("k2"));
  ask(request("k1", "{}", "anna"));
  ask(request(""));
  ask(request(""));
  EXPECT_EQ(made, 5) << "other keys, other callers and no key are other requests";
}

TEST_F(IdempotencyTest, AnotherRequestUnderTheSameKeyIsRefused) {
  ask(request("k1"));
  EXPECT_EQ(status_of(request("k1", "{\"a\": 1}")), 422);
  net::Request elsewhere = request("k1");
  elsewhere.path = "/others";
  EXPECT_EQ(status_of(elsewhere), 422);
  EXPECT_EQ(made, 1);
  for (const std::string& key : {std::string("a b"), std::string(201, 'k'), std::string("\xc3\xa4")})
    EXPECT_EQ(status_of(request(key)), 400);
  net::Request empty = request("x");
  empty.headers["idempotency-key"] = "";
  EXPECT_EQ(status_of(empty), 400);
}

TEST_F(IdempotencyTest, WhatFailedMayBeTriedAgain) {
  EXPECT_EQ(ask(request("k1"), 409).status, 409);
  EXPECT_THROW(idempotency->answer(request("k1"),
                                   [](const net::Request&) -> net::Response {
                                     throw Error(ErrorKind::unavailable, "not now");
                                   }),
               Error);
  EXPECT_EQ(ask(request("k1")).status, 201);
  EXPECT_EQ(made, 2);
}

TEST_F(IdempotencyTest, AfterADayItIsForgotten) {
  ask(request("k1"));
  now += std::chrono::hours(23);
  ask(request("k1"));
  EXPECT_EQ(made, 1);
  now += std::chrono::hours(2);
  ask(request("k1", "{\"other\": true}"));
  EXPECT_EQ(made, 2);
  idempotency->forget_old();
  ask(request("k1", "{\"other\": true}"));
  EXPECT_EQ(made, 2);
}

TEST_F(IdempotencyTest, WhileTheFirstIsUnderWayTheOthersAreToldSo) {
  std::latch begun(1), may_end(1);
  auto first = std::async(std::launch::async, [&] {
    return idempotency->answer(request("k1"), [&](const net::Request&) {
      begun.count_down();
      may_end.wait();
      return net::bytes_response(201, "application/json", net::share("{}"));
    });
  });
  begun.wait();
  EXPECT_EQ(status_of(request("k1")), 409);
  EXPECT_EQ(status_of(request("k2")), 201);
  may_end.count_down();
  EXPECT_EQ(first.get().status, 201);
  EXPECT_EQ(status_of(request("k1")), 201);
  EXPECT_EQ(made, 1);
}

TEST_F(IdempotencyTest, AnswersAreKeptOverARestart) {
  ask(request("k1"));
  open();
  ask(request("k1"));
  EXPECT_EQ(made, 1);
}

TEST_F(IdempotencyTest, WhatNoDiskMayKeepIsKeptInMemory) {
  const auto ask_in_memory = [&](const std::string& key, const std::string& user = {}) {
    return idempotency->answer(
        request(key, "{}", user),
        [&](const net::Request&) {
          return net::bytes_response(201, "application/json", net::share(std::to_string(++made)));
        },
        Idempotency::Place::memory);
  };
  EXPECT_EQ(text(ask_in_memory("k1")), "1");
  EXPECT_EQ(text(ask_in_memory("k1")), "1");
  EXPECT_EQ(status_of(request("k1", "{\"another\": 1}")), 422);
  EXPECT_EQ(store::IdempotencyTable(database()).find("", "k1"), std::nullopt);
  EXPECT_EQ(text(ask_in_memory("k1", "anna")), "2");
  idempotency->forget_about("anna");
  EXPECT_EQ(text(ask_in_memory("k1", "anna")), "3");
  now += std::chrono::hours(25);
  idempotency->forget_old();
  for (int i = 0; i < 1001; ++i) {
    ask_in_memory("many" + std::to_string(i));
    now += std::chrono::milliseconds(1);
  }
  EXPECT_EQ(text(ask_in_memory("many1")), "5") << "the last 1000 are there";
  EXPECT_EQ(text(ask_in_memory("many0")), "1005");
}

}  // namespace
}  // namespace ream::api
