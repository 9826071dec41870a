// WebSocket frames that are broken, too large, or never end.
#include "hostile_fixture.hpp"

namespace ream::test {
namespace {

using namespace std::chrono_literals;

class WebSocketFramesTest : public HostileTest {
 protected:
  static constexpr int text = 1, binary = 2, ping = 9;

  /// The first bytes of a masked frame whose payload of `size` bytes is still to come.
  static std::string head_of(int first_byte, uint64_t size) {
    std::string frame{static_cast<char>(first_byte), static_cast<char>(0x80 | 127)};
    for (int shift = 56; shift >= 0; shift -= 8) frame += static_cast<char>(size >> shift & 0xff);
    return frame + std::string(4, '\0');
  }

  /// Says it on both of the session's sockets; the code each is closed with, 0 for a connection that just
  /// ends.
  void expect_close(const std::string& what, const std::vector<uint16_t>& codes, const std::string& bytes) {
    for (const std::string& path : {stream_path(), device_path()}) {
      RawWebSocket client(port(), path);
      ASSERT_EQ(client.handshake().status, 101) << client.handshake().body;
      client.socket().try_send(bytes);
      const uint16_t code = close_code_of(client);
      EXPECT_TRUE(std::find(codes.begin(), codes.end(), code) != codes.end())
          << what << " " << path << ": " << code;
    }
    expect_others_are_served();
  }

  static uint16_t close_code_of(RawWebSocket& client) {
    try {
      for (;;)
        if (const auto code = client.receive().close_code()) return *code;
    } catch (const std::runtime_error&) {
      return 0;
    }
  }
};

TEST_F(WebSocketFramesTest, BrokenFramesCloseTheConnectionWithTheirCode) {
  start();
  const std::string masked_x = std::string("\x81\0\0\0\0x", 6);
  expect_close("unmasked", {1002}, std::string("\x82\x01x", 3));
  expect_close("reserved bit", {1002}, "\xc2" + masked_x);
  expect_close("unknown opcode", {1002}, "\x83" + masked_x);
  expect_close("unknown control opcode", {1002}, "\x8b" + masked_x);
  expect_close("continuation of nothing", {1002}, "\x80" + masked_x);
  expect_close("fragmented ping", {1002}, "\x09" + masked_x);
  expect_close("large ping", {1002}, head_of(0x89, 126) + std::string(126, 'x'));
  expect_close("a new message within another", {1002}, "\x02" + masked_x + "\x82" + masked_x);
  expect_close("text that is no UTF-8", {1007}, std::string("\x81\x82\0\0\0\0\xff\xfe", 8));
  expect_close("close of one byte", {1002}, std::string("\x88\x81\0\0\0\0x", 7));
  expect_close("close with a code that does not exist", {1002}, std::string("\x88\x82\0\0\0\0\x03\xed", 8));
  expect_close("a length that is not the shortest", {1002}, head_of(0x82, 5) + "hello");
}

TEST_F(WebSocketFramesTest, MessagesBeyondTheLimitAreNotRead) {
  start();
  expect_close("65 KiB", {1009}, head_of(0x82, 65 * 1024 + 1) + std::string(1024, 'x'));
  expect_close("100 MB", {1009}, head_of(0x82, 100'000'000));
  expect_close("2^62", {1009, 1002}, head_of(0x82, uint64_t{1} << 62));
  expect_close("2^63", {1009, 1002}, head_of(0x82, uint64_t{1} << 63));
  for (const std::string& path : {stream_path(), device_path()}) {
    RawWebSocket client(port(), path);
    client.send_frame(binary, std::string(40'000, 'x'), false);
    client.send_frame(0, std::string(40'000, 'x'), false);
    EXPECT_EQ(close_code_of(client), 1009) << path;
  }
}

TEST_F(WebSocketFramesTest, AMessageBeyondTheLimitMayEndBeforeItsConnectionDoes) {
  start();
  RawWebSocket client(port(), stream_path());
  client.send_frame(binary, std::string(40'000, 'x'), false);
  client.socket().send(head_of(0x80, 70'000) + std::string(1'000, 'x'));
  std::this_thread::sleep_for(200ms);  // the running session has more to say meanwhile
  EXPECT_NO_THROW(client.socket().send(std::string(20'000, 'x')));
  std::this_thread::sleep_for(50ms);
  EXPECT_NO_THROW(client.socket().send(std::string(49'000, 'x'))) << "cut in the middle of its message";
  EXPECT_EQ(close_code_of(client), 1009);
}

TEST_F(WebSocketFramesTest, FloodsOfFramesEnd) {
  start([](net::Limits& limits) { limits.websocket_messages = {100.0, 500.0}; });
  for (const auto& [opcode, final] : {std::pair{ping, true}, {0, false}, {binary, true}, {text, true}}) {
    RawWebSocket client(port(), stream_path());
    if (opcode == 0) client.send_frame(binary, "", false);
    try {
      for (int i = 0; i < 2000; ++i) client.send_frame(opcode, "", final);
    } catch (const std::runtime_error&) {
    }
    EXPECT_EQ(close_code_of(client), 1008) << opcode;
  }
  expect_others_are_served();
}

TEST_F(WebSocketFramesTest, AMessageThatNeverEndsCostsNoMoreThanItsPart) {
  start();
  std::vector<std::unique_ptr<RawWebSocket>> all;
  for (int i = 0; i < 100; ++i) {
    all.push_back(std::make_unique<RawWebSocket>(port(), i % 2 == 0 ? stream_path() : device_path()));
    all.back()->socket().try_send(head_of(0x82, 60'000) + std::string(50'000, 'x'));
  }
  expect_others_are_served();
}

TEST_F(WebSocketFramesTest, AViewerThatReadsNothingIsCut) {
  start([](net::Limits& limits) { limits.write = 500ms; });
  std::vector<std::unique_ptr<RawWebSocket>> deaf;
  for (int i = 0; i < 10; ++i)
    deaf.push_back(
        std::make_unique<RawWebSocket>(port(), stream_path(), std::map<std::string, std::string>{}, 4096));
  for (int i = 0; i < 20; ++i) {
    expect_others_are_served();
    std::this_thread::sleep_for(50ms);
  }
}

TEST_F(WebSocketFramesTest, OneWhoAnswersNoPingIsDropped) {
  start([](net::Limits& limits) { limits.idle = 400ms; });
  RawWebSocket silent(port(), device_path());
  EXPECT_EQ(silent.socket().receive_all().substr(0, 1), "\x89");
}

TEST_F(WebSocketFramesTest, HandshakesThatAreNoneAreRefused) {
  start();
  const std::string upgrade = "Upgrade: websocket\r\nConnection: Upgrade\r\n";
  for (const std::string& lines :
       {std::string("Upgrade: websocket\r\n"), upgrade, upgrade + "Sec-WebSocket-Version: 13\r\n",
        upgrade + "Sec-WebSocket-Version: 12\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n",
        upgrade + "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: " + std::string(4000, 'x') + "\r\n"}) {
    RawSocket socket(port());
    socket.send(get_head(stream_path()) + lines + "\r\n");
    socket.end_sending();
    const std::string answer = socket.receive_all();
    EXPECT_EQ(answer.find("HTTP/1.1 101"), std::string::npos) << lines;
  }
  expect_others_are_served();
}

}  // namespace
}  // namespace ream::test
