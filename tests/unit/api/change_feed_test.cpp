#include "api/change_feed.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace ream::api {
namespace {

using nlohmann::json;

net::Caller caller_of(const std::string& role, const std::string& user_id = "u") {
  return {user_id, "", role, {}, {}};
}

std::shared_ptr<const session::SessionRequest> session_of(const std::string& trainee_id) {
  auto request = std::make_shared<session::SessionRequest>();
  request->id = "abcd2345";
  request->trainee_id = trainee_id;
  return request;
}

/// Everything that comes without waiting.
std::vector<json> heard(net::WebSocketSession& listener) {
  std::vector<json> messages;
  while (const auto next = listener.next()) {
    const net::Bytes& bytes = **next;
    messages.push_back(json::parse(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size())));
  }
  return messages;
}

class ChangeFeedTest : public testing::Test {
 protected:
  const std::shared_ptr<ChangeFeed> feed = std::make_shared<ChangeFeed>(4);
};

TEST_F(ChangeFeedTest, GreetsAndTellsInOrderAndWakesWhoListens) {
  feed->publish({"case", "before", "changed"});
  const auto listener = feed->listen(caller_of("operator"), {});
  EXPECT_TRUE(listener->sends_text());
  int woken = 0;
  listener->on_open([&] { ++woken; });
  const auto hello = heard(*listener);
  ASSERT_EQ(hello.size(), 1u);
  EXPECT_EQ(hello[0].at("kind"), "hello");
  EXPECT_EQ(hello[0].at("missed"), false);
  feed->publish({"case", "demo", "changed"});
  feed->publish({"job", "j1", "done"});
  EXPECT_EQ(woken, 2);
  const auto told = heard(*listener);
  ASSERT_EQ(told.size(), 2u);
  EXPECT_EQ(told[0].at("id"), "demo");
  EXPECT_EQ(told[1].at("change"), "done");
  EXPECT_EQ(told[0].at("number").get<uint64_t>(), hello[0].at("number").get<uint64_t>() + 1);
  EXPECT_EQ(told[1].at("number").get<uint64_t>(), hello[0].at("number").get<uint64_t>() + 2);
  listener->on_close();
  feed->publish({"case", "demo", "changed"});
  EXPECT_EQ(woken, 2);
}

TEST_F(ChangeFeedTest, WhoComesBackMissesNothingOrIsToldSo) {
  const auto first = feed->listen(caller_of("operator"), {});
  const uint64_t number = heard(*first).at(0).at("number");
  for (const char* id : {"a", "b", "c"}) feed->publish({"case", id, "changed"});
  const auto told = heard(*feed->listen(caller_of("operator"), number + 1));
  ASSERT_EQ(told.size(), 3u);
  EXPECT_EQ(told[0].at("missed"), false);
  EXPECT_EQ(told[1].at("id"), "b");
  EXPECT_EQ(told[2].at("id"), "c");
  for (const char* id : {"d", "e", "f"}) feed->publish({"case", id, "changed"});
  const auto late = heard(*feed->listen(caller_of("operator"), number));
  ASSERT_EQ(late.size(), 1u);
  EXPECT_EQ(late[0].at("missed"), true);
  const auto whole = heard(*feed->listen(caller_of("operator"), number + 2));
  EXPECT_EQ(whole.size(), 5u) << "the oldest that is kept is the next of what was seen";
  const auto stranger = heard(*feed->listen(caller_of("operator"), number + 1'000'000'000'000));
  EXPECT_EQ(stranger.at(0).at("missed"), true) << "a number that this server has never given";
}

TEST_F(ChangeFeedTest, WhoIsTooSlowIsToldToReadAgain) {
  const auto listener = feed->listen(caller_of("operator"), {});
  heard(*listener);
  for (int i = 0; i < 10; ++i) feed->publish({"case", std::to_string(i), "changed"});
  const auto told = heard(*listener);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].at("kind"), "missed");
  feed->publish({"case", "next", "changed"});
  EXPECT_EQ(heard(*listener).at(0).at("id"), "next");
}

TEST_F(ChangeFeedTest, EverybodyHearsWhatTheyMayKnow) {
  const auto anna = feed->listen(caller_of("trainee", "anna"), {}),
             ben = feed->listen(caller_of("trainee", "ben"), {}),
             teacher = feed->listen(caller_of("instructor"), {}),
             watcher = feed->listen(caller_of("viewer", ""), {});
  for (const auto& each : {&anna, &ben, &teacher, &watcher}) heard(**each);
  feed->publish({"session", "abcd2345", "running", session_of("anna")});
  feed->publish({"user", "anna", "changed"});
  feed->publish({"case", "demo", "changed"});
  feed->publish({"job", "j1", "done"});
  const auto count = [](net::WebSocketSession& listener) { return heard(listener).size(); };
  EXPECT_EQ(count(*anna), 2u);
  EXPECT_EQ(count(*ben), 1u);
  EXPECT_EQ(count(*teacher), 3u);
  EXPECT_EQ(count(*watcher), 1u);
}

}  // namespace
}  // namespace ream::api
