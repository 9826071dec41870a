// Many at once, and much at once.
#include "hostile_fixture.hpp"

namespace ream::test {
namespace {

using namespace std::chrono_literals;

constexpr int crowd = 1000;

class CrowdTest : public HostileTest {
 protected:
  /// A thousand connections that have each said `words`.
  std::vector<std::unique_ptr<RawSocket>> come(const std::string& words) {
    std::vector<std::unique_ptr<RawSocket>> all;
    for (int i = 0; i < crowd; ++i) {
      all.push_back(std::make_unique<RawSocket>(port()));
      if (!words.empty()) all.back()->try_send(words);
    }
    return all;
  }
};

TEST_F(CrowdTest, AThousandIdleConnectionsKeepNobodyOut) {
  start();
  const auto idle = come({});
  for (int i = 0; i < 20; ++i) expect_others_are_served();
  const double bytes_each = 1024.0 * static_cast<double>(memory_gained_kib()) / net::Limits{}.connections;
  RecordProperty("bytes_per_idle_connection", std::to_string(static_cast<int>(bytes_each)));
  EXPECT_TRUE(!memory_is_measurable() || bytes_each < 64 * 1024) << bytes_each;
}

TEST_F(CrowdTest, AThousandHalfRequestsKeepNobodyOut) {
  start();
  const auto half = come(get_head("/healthz") + "X-Slow: ");
  for (int i = 0; i < 20; ++i) expect_others_are_served();
}

TEST_F(CrowdTest, AThousandHalfBodiesKeepNobodyOut) {
  start();
  const auto half =
      come("POST /api/v1/sessions HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000000\r\n\r\n{");
  for (int i = 0; i < 20; ++i) expect_others_are_served();
}

TEST_F(CrowdTest, AThousandIdleConnectionsDoNotEndAViewersStream) {
  start();
  RawWebSocket viewer(port(), stream_path());
  ASSERT_EQ(viewer.handshake().status, 101);
  const auto idle = come({});
  for (int i = 0; i < 100; ++i) EXPECT_NE(viewer.receive().opcode, 8);
}

TEST_F(CrowdTest, DribbledHeadersAreCutWhileOthersAreServed) {
  start([](net::Limits& limits) { limits.header = 500ms; });
  std::vector<std::unique_ptr<RawSocket>> slow;
  for (int i = 0; i < 100; ++i) slow.push_back(std::make_unique<RawSocket>(port()));
  const std::string head = get_head("/healthz") + "X-Slow: " + std::string(100, 'x') + "\r\n\r\n";
  for (size_t sent = 0; sent < 20; ++sent) {
    for (const auto& one : slow) one->try_send(head.substr(sent, 1));
    expect_others_are_served();
    std::this_thread::sleep_for(50ms);
  }
  for (const auto& one : slow) EXPECT_EQ(one->receive_all(), "");
}

TEST_F(CrowdTest, AHundredMegabytesThatAreAnnouncedAreRefusedAtOnce) {
  start();
  for (const char* path : {"/api/v1/sessions", "/api/v1/uploads/x", "/healthz", "/"}) {
    RawSocket socket(port());
    socket.send("POST " + std::string(path) +
                " HTTP/1.1\r\nHost: localhost\r\nContent-Length: 104857600\r\n\r\n");
    EXPECT_EQ(receive_reply(socket).status, 413) << path;
  }
  expect_others_are_served();
}

TEST_F(CrowdTest, AHundredMegabytesInChunksEndAtTheLimit) {
  start();
  RawSocket socket(port());
  socket.send("POST /api/v1/sessions HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n");
  const std::string chunk = "10000\r\n" + std::string(65536, ' ') + "\r\n";
  for (int i = 0; i < 1600 && socket.try_send(chunk); ++i) {
  }
  look_at_memory();
  EXPECT_EQ(receive_reply(socket).status, 413);
  expect_others_are_served();
}

TEST_F(CrowdTest, ManyLargeBodiesAtOnceAreBounded) {
  start([](net::Limits& limits) { limits.bodies_bytes = 16u << 20; });
  std::vector<std::unique_ptr<RawSocket>> all;
  const std::string head =
      "POST /api/v1/sessions HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1048576\r\n\r\n";
  for (int i = 0; i < 200; ++i) {
    all.push_back(std::make_unique<RawSocket>(port()));
    all.back()->try_send(head + std::string(1'000'000, ' '));
  }
  expect_others_are_served();
}

TEST_F(CrowdTest, EndlessHeadersEndAtTheLimit) {
  start();
  for (const std::string& piece :
       {std::string("X-More: x\r\n"), std::string(11, 'x'), std::string("Cookie: a=b\r\n")}) {
    RawSocket socket(port());
    socket.send(get_head("/healthz"));
    for (int i = 0; i < 1'000'000 && socket.try_send(piece); ++i) {
    }
    look_at_memory();
    EXPECT_EQ(receive_reply(socket).status, 431);
  }
  expect_others_are_served();
}

TEST_F(CrowdTest, ConnectionsThatComeAndGoLeaveNothingBehind) {
  start([](net::Limits& limits) { limits.requests_per_address = {1e6, 1e6}; });
  for (int round = 0; round < 5; ++round) come(get_head("/healthz") + "\r\n");
  // As long as requests of this address wait for a worker, its next one may be told to come later.
  LiveServer::until("the crowd's requests to be answered",
                    [this] { return http_request(port(), "GET", "/healthz").status != 429; });
  expect_others_are_served();
}

}  // namespace
}  // namespace ream::test
