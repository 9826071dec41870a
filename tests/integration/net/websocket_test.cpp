#include "net/websocket.hpp"

#include <gtest/gtest.h>

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "net/listener.hpp"
#include "net/problem.hpp"
#include "support/raw_http.hpp"

namespace ream::net {
namespace {

using test::RawWebSocket;
using namespace std::chrono_literals;

/// What a session and its test share.
struct Desk {
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<SharedBytes> outgoing;
  std::function<void()> wake;
  std::optional<CloseReason> close_reason;
  bool text = false;
  int opened = 0, closed = 0, asked = 0;

  void put(SharedBytes message) {
    std::function<void()> ring;
    {
      const std::lock_guard lock(mutex);
      outgoing.push_back(std::move(message));
      ring = wake;
    }
    if (ring) ring();
  }
  bool wait_closed() {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, 15s, [this] { return closed > 0; });
  }
};

/// Sends what lies on the desk and echoes what comes in; "fail" makes it throw.
class DeskSession final : public WebSocketSession {
 public:
  explicit DeskSession(std::shared_ptr<Desk> desk) : desk_(std::move(desk)) {}

  void on_open(std::function<void()> wake) override {
    const std::lock_guard lock(desk_->mutex);
    desk_->wake = std::move(wake);
    ++desk_->opened;
    desk_->changed.notify_all();
  }
  bool sends_text() const override { return desk_->text; }
  std::optional<SharedBytes> next() override {
    const std::lock_guard lock(desk_->mutex);
    ++desk_->asked;
    if (desk_->outgoing.empty()) return std::nullopt;
    SharedBytes message = desk_->outgoing.front();
    desk_->outgoing.pop_front();
    return message;
  }
  std::optional<CloseReason> close_reason() override {
    const std::lock_guard lock(desk_->mutex);
    return desk_->close_reason;
  }
  void on_message(std::span<const std::byte> message) override {
    const std::string text(reinterpret_cast<const char*>(message.data()), message.size());
    if (text == "fail") throw std::runtime_error("told to fail");
    desk_->put(share("echo " + text));
  }
  void on_close() noexcept override {
    const std::lock_guard lock(desk_->mutex);
    ++desk_->closed;
    desk_->changed.notify_all();
  }

 private:
  std::shared_ptr<Desk> desk_;
};

class WebSocketTest : public testing::Test {
 protected:
  WebSocketTest() {
    router.on_websocket("/stream/{id}", [this](const Request& request) -> std::unique_ptr<WebSocketSession> {
      if (request.parameters.at("id") != "1") throw Error(ErrorKind::not_found, "no such stream");
      return std::make_unique<DeskSession>(desk);
    });
    router.on("GET", "/hello",
              [](const Request&) { return bytes_response(200, "text/plain", share("hello")); });
    options.port = 0;
  }
  uint16_t start() {
    listener = std::make_unique<Listener>(router, options);
    listener->start();
    return listener->port();
  }
  std::shared_ptr<Desk> desk = std::make_shared<Desk>();
  Router router;
  ListenOptions options;
  std::unique_ptr<Listener> listener;
};

TEST_F(WebSocketTest, HandshakeFollowsTheStandardsExample) {
  const RawWebSocket client(start(), "/stream/1");
  EXPECT_EQ(client.handshake().status, 101);
  EXPECT_EQ(client.handshake().headers.at("sec-websocket-accept"), "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=");
  EXPECT_EQ(client.handshake().headers.count("sec-websocket-extensions"), 0u);
}

TEST_F(WebSocketTest, MessagesGoBothWaysWholeAndInOrder) {
  desk->put(share("first"));
  RawWebSocket client(start(), "/stream/1");
  EXPECT_EQ(client.receive().payload, "first");
  const std::string big(3u << 20, 'b');
  desk->put(share(big));
  desk->put(share("after"));
  client.send_binary("hi");
  const auto message = client.receive();
  EXPECT_EQ(message.opcode, 2);
  EXPECT_EQ(message.payload, big);
  EXPECT_EQ(client.receive().payload, "after");
  EXPECT_EQ(client.receive().payload, "echo hi");
}

TEST_F(WebSocketTest, ASessionMaySendText) {
  desk->text = true;
  desk->put(share("{\"number\": 1}"));
  RawWebSocket client(start(), "/stream/1");
  const auto message = client.receive();
  EXPECT_EQ(message.opcode, 1);
  EXPECT_EQ(message.payload, "{\"number\": 1}");
}

TEST_F(WebSocketTest, RefusalsAreProblemsBeforeTheUpgrade) {
  const uint16_t port = start();
  EXPECT_EQ(RawWebSocket(port, "/stream/2").handshake().status, 404);
  EXPECT_EQ(RawWebSocket(port, "/elsewhere").handshake().status, 404);
  EXPECT_EQ(RawWebSocket(port, "/stream/1", {{"Origin", "http://evil.example"}}).handshake().status, 403);
  EXPECT_EQ(RawWebSocket(port, "/stream/1", {{"Host", "evil.example"}}).handshake().status, 421);
  EXPECT_EQ(test::http_request(port, "GET", "/stream/1").status, 426);
  EXPECT_EQ(desk->opened, 0);
}

TEST_F(WebSocketTest, ClosingByThePeerReachesTheSessionOnce) {
  {
    RawWebSocket client(start(), "/stream/1");
    client.send_close(1000);
    EXPECT_EQ(client.receive().close_code(), 1000);
  }
  EXPECT_TRUE(desk->wait_closed());
  desk->put(share("nobody listens"));
  EXPECT_EQ(desk->closed, 1);
}

TEST_F(WebSocketTest, VanishedPeerReachesTheSession) {
  { RawWebSocket client(start(), "/stream/1"); }
  EXPECT_TRUE(desk->wait_closed());
}

TEST_F(WebSocketTest, ASessionEndsItsConnectionInWordsAfterItsLastMessage) {
  RawWebSocket client(start(), "/stream/1");
  client.send_binary("hi");
  EXPECT_EQ(client.receive().payload, "echo hi");
  {
    const std::lock_guard lock(desk->mutex);
    desk->close_reason = CloseReason{4001, std::string(200, 'w')};
  }
  desk->put(share("last"));
  EXPECT_EQ(client.receive().payload, "last");
  const auto closing = client.receive();
  EXPECT_EQ(closing.close_code(), 4001);
  EXPECT_EQ(closing.payload.substr(2), std::string(123, 'w'));
  client.send_close(4001);
  EXPECT_TRUE(desk->wait_closed());
}

TEST_F(WebSocketTest, FailingSessionIsClosedWith1011) {
  RawWebSocket client(start(), "/stream/1");
  client.send_binary("fail");
  EXPECT_EQ(client.receive().close_code(), 1011);
  client.send_close(1011);
  EXPECT_TRUE(desk->wait_closed());
}

/// With a mask of zeros.
std::string frame(char first, const std::string& payload) {
  return std::string{first, static_cast<char>(0x80 | payload.size())} + std::string(4, '\0') + payload;
}

/// Where the reader finds the peer in the wrong while our close is on its way, each may wait for the other.
TEST_F(WebSocketTest, AClosedConnectionGivesUpItsPlaceWhateverItsReaderStillFinds) {
  options.limits.linger = 100ms;
  options.limits.connections = 2;
  const uint16_t port = start();
  const auto is_served = [port] {
    try {
      return test::http_request(port, "GET", "/hello").status == 200;
    } catch (const std::runtime_error&) {
      return false;
    }
  };
  for (int i = 0; i < 5; ++i) {
    RawWebSocket client(port, "/stream/1");
    client.socket().send(frame('\x82', "fail") + frame('\x89', "") + frame('\x80', "x"));
    if (i % 2 == 0) client.socket().end_sending();
    const auto until = std::chrono::steady_clock::now() + 15s;
    bool served = false;
    while (!(served = is_served()) && std::chrono::steady_clock::now() < until)
      std::this_thread::sleep_for(10ms);
    ASSERT_TRUE(served) << "after " << i + 1 << " such peers";
  }
}

TEST_F(WebSocketTest, OversizedMessageEndsTheConnection) {
  options.limits.websocket_message_bytes = 1000;
  RawWebSocket client(start(), "/stream/1");
  client.send_binary(std::string(2000, 'x'));
  EXPECT_EQ(client.receive().close_code(), 1009);
  EXPECT_TRUE(desk->wait_closed());
}

TEST_F(WebSocketTest, WhoSendsTooMuchIsClosedWith1008) {
  options.limits.websocket_messages = {0.001, 10.0};
  RawWebSocket client(start(), "/stream/1");
  for (int i = 0; i < 12; ++i) client.send_binary("x");
  std::optional<uint16_t> code;
  while (!(code = client.receive().close_code())) {
  }
  EXPECT_EQ(code, 1008);
  EXPECT_TRUE(desk->wait_closed());
}

TEST_F(WebSocketTest, PingsAndEmptyFragmentsCountAsWell) {
  options.limits.websocket_messages = {0.001, 10.0};
  for (const int opcode : {9, 0}) {
    RawWebSocket client(start(), "/stream/1");
    if (opcode == 0) client.send_frame(2, "begin", false);
    for (int i = 0; i < 12; ++i) client.send_frame(opcode, "", opcode == 9);
    std::optional<uint16_t> code;
    while (!(code = client.receive().close_code())) {
    }
    EXPECT_EQ(code, 1008) << opcode;
  }
}

TEST_F(WebSocketTest, SlowViewerIsCutAndOthersAreServedMeanwhile) {
  options.limits.write = 300ms;
  const uint16_t port = start();
  RawWebSocket slow(port, "/stream/1", {}, 4096);
  const auto big = std::make_shared<const Bytes>(64u << 20);
  desk->put(big);
  desk->put(big);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(test::http_request(port, "GET", "/hello").status, 200);
  EXPECT_TRUE(desk->wait_closed());
  EXPECT_LT(slow.socket().receive_all().size(), big->size());
}

TEST_F(WebSocketTest, SilentPeerThatAnswersNoPingIsDropped) {
  options.limits.idle = 400ms;
  RawWebSocket client(start(), "/stream/1");
  EXPECT_TRUE(desk->wait_closed());
}

TEST_F(WebSocketTest, StopSaysGoingAway) {
  RawWebSocket client(start(), "/stream/1");
  client.send_binary("are you there");
  EXPECT_EQ(client.receive().payload, "echo are you there");
  std::thread stopping([this] { listener->stop(); });
  EXPECT_EQ(client.receive().close_code(), 1001);
  client.send_close(1001);
  client.socket().end_sending();
  stopping.join();
  EXPECT_EQ(desk->closed, 1);
}

TEST_F(WebSocketTest, StopMayComeWhileAConnectionBecomesAWebSocket) {
  options.limits.linger = 1ms;
  for (int round = 0; round < 100; ++round) {
    const uint16_t port = start();
    std::thread opening([port] {
      try {
        for (;;) RawWebSocket(port, "/stream/1");
      } catch (const std::runtime_error&) {
      }
    });
    std::this_thread::sleep_for(1ms);
    listener->stop();
    opening.join();
  }
}

TEST_F(WebSocketTest, StopDoesNotWaitForAPeerThatNeverAnswers) {
  options.limits.linger = 200ms;
  options.limits.stop = 500ms;
  RawWebSocket client(start(), "/stream/1");
  client.send_binary("x");
  client.receive();
  listener->stop();
  EXPECT_EQ(desk->closed, 1);
  listener.reset();
  desk->put(share("wake after the end"));
}

TEST_F(WebSocketTest, WakesFromManyThreadsLoseNothing) {
  RawWebSocket client(start(), "/stream/1");
  constexpr int threads = 4, each = 500;
  std::vector<std::thread> writers;
  for (int t = 0; t < threads; ++t)
    writers.emplace_back([this] {
      for (int i = 0; i < each; ++i) desk->put(share("m"));
    });
  for (int i = 0; i < threads * each; ++i) EXPECT_EQ(client.receive().payload, "m");
  for (std::thread& writer : writers) writer.join();
}

}  // namespace
}  // namespace ream::net
