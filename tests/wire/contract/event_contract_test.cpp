#include "contract_fixture.hpp"

namespace ream::test {
namespace {

class EventContractTest : public ContractTest {
 protected:
  /// The next message, which is as described.
  json next(RawWebSocket& listener) {
    const RawWebSocket::Message message = listener.receive();
    EXPECT_EQ(message.opcode, 1) << "a text";
    const json told = json::parse(message.payload);
    for (const std::string& fault : faults(contract.at("components").at("schemas").at("ChangeMessage"), told))
      ADD_FAILURE() << fault << " in " << message.payload;
    return told;
  }
  /// The next about that thing; others come in between.
  json next_about(RawWebSocket& listener, const std::string& id, const std::string& change) {
    for (;;) {
      json told = next(listener);
      if (told.value("id", "") == id && told.at("change") == change) return told;
    }
  }
  void expect_listening(const std::string& path, int status,
                        const std::map<std::string, std::string>& headers = {}) {
    const RawWebSocket listener(server->port(), path, headers);
    expect_as_described("GET", events, status, listener.handshake());
  }

  const std::string events = "/api/v1/events";
};

TEST_F(EventContractTest, EveryDescribedReplyIsGivenAsDescribed) {
  start();
  expect_listening(events, 101);
  expect_listening(events + "?since=5", 101);
  expect_listening(events + "?since=-5", 422);
  expect_listening(events + "?from=5", 422);
  expect_listening(events, 403, foreign);
  expect_get(events, events, 426);
  expect_all_given({"events"});
}

TEST_F(EventContractTest, TheLifeOfASessionIsTold) {
  start();
  RawWebSocket listener(server->port(), events);
  const json hello = next(listener);
  EXPECT_EQ(hello.at("kind"), "hello");
  const std::string id = create(), path = all + "/" + id;
  next_about(listener, id, "created");
  post(path + "/start");
  next_about(listener, id, "running");
  post(path + "/annotations", R"({"words": "too steep"})");
  next_about(listener, id, "annotated");
  post(path + "/pause");
  next_about(listener, id, "paused");
  http_request(server->port(), "PATCH", path, R"({"title": "first try"})");
  next_about(listener, id, "changed");
  engine->made(0).set(SessionState::fault, "the device fell silent");
  const json last = next_about(listener, id, "fault");

  RawWebSocket again(server->port(), events + "?since=" + hello.at("number").dump());
  EXPECT_EQ(next(again).at("missed"), false);
  EXPECT_EQ(next_about(again, id, "fault").at("number"), last.at("number"));
  RawWebSocket late(server->port(), events + "?since=1");
  EXPECT_EQ(next(late).at("missed"), true);
}

TEST_F(EventContractTest, ViewersAndDevicesOfAResetSessionAreToldWhereItGoesOn) {
  start();
  const json made = json::parse(post(all, R"({"case": "planned", "device": "network"})").body);
  const std::string path = all + "/" + made.at("id").get<std::string>();
  post(path + "/start");
  RawWebSocket viewer(server->port(), path + "/stream"), device(server->port(), path + "/device");
  for (RawWebSocket* each : {&viewer, &device}) EXPECT_EQ(each->receive().opcode, 2);
  const json next = json::parse(post(path + "/reset").body);
  for (RawWebSocket* each : {&viewer, &device}) {
    each->send_binary("still here");
    RawWebSocket::Message last = each->receive();
    while (last.opcode != 8) last = each->receive();
    EXPECT_EQ(last.close_code(), 4001);
    EXPECT_NE(last.payload.find(next.at("id").get<std::string>()), std::string::npos);
  }
}

}  // namespace
}  // namespace ream::test
