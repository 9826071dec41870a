#include "net/listener.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <thread>

#include "core/file.hpp"
#include "net/file_body.hpp"
#include "net/problem.hpp"
#include "support/expect_error.hpp"
#include "support/raw_http.hpp"
#include "support/temporary_folder.hpp"

namespace ream::net {
namespace {

using test::http_request;
using test::HttpReply;
using test::RawSocket;
using test::receive_reply;
using namespace std::chrono_literals;

class ListenerTest : public testing::Test {
 protected:
  ListenerTest() {
    router.on("GET", "/hello",
              [](const Request&) { return bytes_response(200, "text/plain", share("hello")); });
    router.on("POST", "/echo",
              [](const Request& request) { return bytes_response(200, "text/plain", share(request.body)); });
    router.on("GET", "/large",
              [this](const Request&) { return bytes_response(200, "application/octet-stream", large); });
    router.on("GET", "/wait", [this](const Request&) {
      waiting.set_value();
      release.get_future().wait();
      return bytes_response(200, "text/plain", share("late"));
    });
    router.on("GET", "/fails", [](const Request&) -> Response { throw std::runtime_error("bang"); });
    router.on("GET", "/file", [this](const Request& request) {
      return file_response(request, {file, "application/octet-stream", "a file"});
    });
    options.port = 0;
    options.limits.body_bytes = 1000;
    options.limits.header_bytes = 2000;
  }

  uint16_t start() {
    listener = std::make_unique<Listener>(router, options);
    listener->start();
    return listener->port();
  }

  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "file.bin";
  Router router;
  ListenOptions options;
  const SharedBytes large = std::make_shared<const Bytes>(64u << 20);
  std::promise<void> waiting, release;
  std::unique_ptr<Listener> listener;
};

std::string get_line(const std::string& path) {
  return "GET " + path + " HTTP/1.1\r\nHost: localhost\r\n\r\n";
}

TEST_F(ListenerTest, AnswersWithSecurityHeaders) {
  const HttpReply reply = http_request(start(), "GET", "/hello");
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.body, "hello");
  EXPECT_EQ(reply.headers.at("content-type"), "text/plain");
  EXPECT_EQ(reply.headers.at("x-content-type-options"), "nosniff");
  EXPECT_NE(reply.headers.at("content-security-policy").find("'wasm-unsafe-eval'"), std::string::npos);
}

TEST_F(ListenerTest, HeadHasLengthButNoBody) {
  const uint16_t port = start();
  RawSocket socket(port);
  socket.send("HEAD /hello HTTP/1.1\r\nHost: localhost\r\n\r\n" + get_line("/hello"));
  const HttpReply head = receive_reply(socket, false);
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.headers.at("content-length"), "5");
  EXPECT_EQ(receive_reply(socket).body, "hello");
}

TEST_F(ListenerTest, KeepsConnectionAliveForPipelinedRequests) {
  RawSocket socket(start());
  std::string many;
  for (int i = 0; i < 20; ++i) many += get_line("/hello");
  socket.send(many);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(receive_reply(socket).body, "hello");
}

TEST_F(ListenerTest, ClosesWhenAskedTo) {
  RawSocket socket(start());
  socket.send("GET /hello HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  EXPECT_NE(socket.receive_all().find("hello"), std::string::npos);
}

TEST_F(ListenerTest, BodyIsHandedOverWholeAlsoAfterContinue) {
  const uint16_t port = start();
  EXPECT_EQ(http_request(port, "POST", "/echo", std::string(1000, 'x')).body, std::string(1000, 'x'));
  RawSocket socket(port);
  socket.send("POST /echo HTTP/1.1\r\nHost: localhost\r\nContent-Length: 3\r\nExpect: 100-continue\r\n\r\n");
  EXPECT_EQ(socket.receive_until("\r\n\r\n"), "HTTP/1.1 100 Continue\r\n\r\n");
  socket.send("abc");
  EXPECT_EQ(receive_reply(socket).body, "abc");
}

TEST_F(ListenerTest, OversizedBodyIs413EvenWhenItsSizeIsNotAnnounced) {
  const uint16_t port = start();
  EXPECT_EQ(http_request(port, "POST", "/echo", std::string(1001, 'x')).status, 413);
  RawSocket socket(port);
  socket.send("POST /echo HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n");
  socket.try_send("fa0\r\n" + std::string(4000, 'x') + "\r\n0\r\n\r\n");
  const HttpReply reply = receive_reply(socket);
  EXPECT_EQ(reply.status, 413);
  EXPECT_EQ(reply.headers.at("content-type"), "application/problem+json");
}

TEST_F(ListenerTest, OversizedHeaderIs431) {
  EXPECT_EQ(http_request(start(), "GET", "/hello", "", {{"X-Long", std::string(4000, 'x')}}).status, 431);
}

TEST_F(ListenerTest, TruncatedRequestIsExplainedAndEnds) {
  RawSocket socket(start());
  socket.send("POST /echo HTTP/1.1\r\nHost: localhost\r\nContent-Length: 100\r\n\r\nonly this");
  socket.end_sending();
  EXPECT_EQ(receive_reply(socket).status, 400);
  EXPECT_EQ(socket.receive_all(), "");
}

TEST_F(ListenerTest, WhatIsNotHttpIs400AndTheServerLivesOn) {
  const uint16_t port = start();
  for (const std::string& line :
       {std::string("\x16\x03\x01\x02"), std::string("GET\r\n\r\n"), std::string("GET /hello HTTP/9\r\n\r\n"),
        std::string("GET /%zz HTTP/1.1\r\nHost: localhost\r\n\r\n")}) {
    RawSocket socket(port);
    socket.send(line);
    socket.end_sending();
    EXPECT_EQ(receive_reply(socket).status, 400) << line;
  }
  RawSocket silent(port);
  silent.end_sending();
  EXPECT_EQ(silent.receive_all(), "");
  EXPECT_EQ(http_request(port, "GET", "/hello").status, 200);
}

TEST_F(ListenerTest, ForeignHostAndOriginAreRefused) {
  const uint16_t port = start();
  EXPECT_EQ(http_request(port, "GET", "/hello", "", {{"Host", "evil.example"}}).status, 421);
  EXPECT_EQ(http_request(port, "POST", "/echo", "x", {{"Origin", "http://evil.example"}}).status, 403);
}

TEST_F(ListenerTest, HandlerFailureIsPlain500) {
  const HttpReply reply = http_request(start(), "GET", "/fails");
  EXPECT_EQ(reply.status, 500);
  EXPECT_EQ(reply.body.find("bang"), std::string::npos);
}

TEST_F(ListenerTest, BlockedHandlerDoesNotHoldOthersUp) {
  const uint16_t port = start();
  RawSocket blocked(port);
  blocked.send(get_line("/wait"));
  waiting.get_future().wait();
  EXPECT_EQ(http_request(port, "GET", "/hello").status, 200);
  release.set_value();
  EXPECT_EQ(receive_reply(blocked).body, "late");
}

TEST_F(ListenerTest, SlowReaderIsCutAndDoesNotHoldOthersUp) {
  options.limits.write = 300ms;
  const uint16_t port = start();
  RawSocket slow(port, 4096);
  slow.send(get_line("/large"));
  for (int i = 0; i < 10; ++i) EXPECT_EQ(http_request(port, "GET", "/hello").status, 200);
  std::this_thread::sleep_for(1s);
  EXPECT_LT(slow.receive_all().size(), large->size());
}

TEST_F(ListenerTest, LargeReplyArrivesWhole) {
  EXPECT_EQ(http_request(start(), "GET", "/large").body.size(), large->size());
}

/// Bytes that differ wherever they are taken from.
std::string numbered(size_t bytes) {
  std::string text;
  for (uint32_t i = 0; text.size() < bytes; ++i) text += std::to_string(i) + ",";
  text.resize(bytes);
  return text;
}

TEST_F(ListenerTest, FileIsSentInPiecesAndInParts) {
  const std::string whole = numbered(1'000'003);
  write_file_atomically(file, whole);
  options.limits.file_piece_bytes = 4096;
  const uint16_t port = start();
  const HttpReply all = http_request(port, "GET", "/file");
  EXPECT_EQ(all.status, 200);
  EXPECT_EQ(all.body, whole);
  EXPECT_EQ(all.headers.at("accept-ranges"), "bytes");
  const HttpReply part = http_request(port, "GET", "/file", "", {{"Range", "bytes=500000-"}});
  EXPECT_EQ(part.status, 206);
  EXPECT_EQ(part.headers.at("content-range"), "bytes 500000-1000002/1000003");
  EXPECT_EQ(part.body, whole.substr(500000));
  const HttpReply head = http_request(port, "HEAD", "/file");
  EXPECT_EQ(head.headers.at("content-length"), "1000003");
  EXPECT_EQ(head.body, "");
}

TEST_F(ListenerTest, FileDoesNotEndTheConnection) {
  write_file_atomically(file, numbered(300'000));
  RawSocket socket(start());
  socket.send(get_line("/file") + "HEAD /file HTTP/1.1\r\nHost: localhost\r\n\r\n" + get_line("/hello"));
  EXPECT_EQ(receive_reply(socket).body, numbered(300'000));
  EXPECT_EQ(receive_reply(socket, false).headers.at("content-length"), "300000");
  EXPECT_EQ(receive_reply(socket).body, "hello");
}

TEST_F(ListenerTest, EmptyFileIsAnEmptyBody) {
  write_file_atomically(file, std::string_view());
  EXPECT_EQ(http_request(start(), "GET", "/file").headers.at("content-length"), "0");
}

TEST_F(ListenerTest, FileThatShrinksOnTheWayCutsTheReply) {
  write_file_atomically(file, numbered(64u << 20));
  RawSocket slow(start(), 4096);
  slow.send(get_line("/file"));
  slow.receive_until("\r\n\r\n");
  std::filesystem::resize_file(file, 100);
  EXPECT_LT(slow.receive_all().size(), 64u << 20);
  EXPECT_EQ(http_request(listener->port(), "GET", "/hello").status, 200);
}

TEST_F(ListenerTest, StopWhileAFileIsSentEnds) {
  options.limits.stop = 200ms;
  write_file_atomically(file, numbered(64u << 20));
  RawSocket slow(start(), 4096);
  slow.send(get_line("/file"));
  slow.receive_until("\r\n\r\n");
  listener->stop();
  EXPECT_LT(slow.receive_all().size(), 64u << 20);
}

TEST_F(ListenerTest, IdleConnectionIsClosed) {
  options.limits.idle = options.limits.header = 200ms;
  const uint16_t port = start();
  RawSocket idle(port), halfway(port);
  halfway.send("GET /hello HTTP/1.1\r\nHost: loc");
  EXPECT_EQ(idle.receive_all(), "");
  EXPECT_EQ(halfway.receive_all(), "");
}

TEST_F(ListenerTest, InAFullHouseTheOldestIdleConnectionGivesWay) {
  options.limits.connections = 2;
  const uint16_t port = start();
  RawSocket one(port), two(port);
  one.send(get_line("/hello"));
  EXPECT_EQ(receive_reply(one).status, 200);
  two.send(get_line("/hello"));
  EXPECT_EQ(receive_reply(two).status, 200);
  EXPECT_EQ(http_request(port, "GET", "/hello").status, 200);
  EXPECT_EQ(one.receive_all(), "");
  two.send(get_line("/hello"));
  EXPECT_EQ(receive_reply(two).status, 200);
}

TEST_F(ListenerTest, WhereAllConnectionsAreBusyTheNewcomerIsTold) {
  options.limits.connections = 1;
  const uint16_t port = start();
  RawSocket busy(port);
  busy.send(get_line("/wait"));
  waiting.get_future().wait();
  EXPECT_EQ(http_request(port, "GET", "/hello").status, 503);
  release.set_value();
  EXPECT_EQ(receive_reply(busy).body, "late");
  EXPECT_EQ(http_request(port, "GET", "/hello").status, 200);
}

TEST_F(ListenerTest, DribbledHeaderIsCutInTime) {
  options.limits.header = 300ms;
  const uint16_t port = start();
  RawSocket slow(port);
  const std::string line = get_line("/hello");
  size_t sent = 0;
  while (sent < line.size() && slow.try_send(line.substr(sent, 1))) {
    ++sent;
    std::this_thread::sleep_for(50ms);
  }
  EXPECT_EQ(slow.receive_all(), "");
}

TEST_F(ListenerTest, DribbledBodyIsCutInTimeAndASteadyOneIsNot) {
  options.limits.body = 300ms;
  options.limits.min_bytes_per_s = 100;
  const uint16_t port = start();
  const std::string head = "POST /echo HTTP/1.1\r\nHost: localhost\r\nContent-Length: 400\r\n\r\n";
  RawSocket slow(port), steady(port);
  slow.send(head);
  steady.send(head);
  for (int i = 0; i < 20; ++i) {
    slow.try_send("x");
    steady.send(std::string(20, 'x'));
    std::this_thread::sleep_for(50ms);
  }
  EXPECT_EQ(slow.receive_all(), "");
  EXPECT_EQ(receive_reply(steady).body.size(), 400u);
}

TEST_F(ListenerTest, ReplyThatIsReadTooSlowlyIsCut) {
  options.limits.write = 500ms;
  options.limits.min_bytes_per_s = 100u << 20;
  RawSocket slow(start(), 4096);
  slow.send(get_line("/large"));
  size_t got = 0;
  try {
    for (; got < large->size(); got += 4096) {
      slow.receive(4096);
      std::this_thread::sleep_for(1ms);
    }
  } catch (const std::runtime_error&) {
  }
  EXPECT_LT(got, large->size());
}

TEST_F(ListenerTest, TooManyRequestsOfOneAddressAre429BeforeAnyHandler) {
  options.limits.requests_per_address = {0.001, 3.0};
  const uint16_t port = start();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(http_request(port, "GET", "/hello").status, 200);
  const HttpReply refused = http_request(port, "GET", "/hello");
  EXPECT_EQ(refused.status, 429);
  EXPECT_GE(std::stoi(refused.headers.at("retry-after")), 1);
  EXPECT_EQ(refused.headers.at("content-type"), "application/problem+json");
}

TEST_F(ListenerTest, BodiesTogetherAreBounded) {
  options.limits.bodies_bytes = 1500;
  options.limits.small_body_bytes = 100;
  const uint16_t port = start();
  const std::string head = "POST /echo HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000\r\n";
  RawSocket first(port);
  first.send(head + "Expect: 100-continue\r\n\r\n");
  first.receive_until("\r\n\r\n");
  EXPECT_EQ(http_request(port, "POST", "/echo", std::string(1000, 'x')).status, 503);
  EXPECT_EQ(http_request(port, "POST", "/echo", std::string(100, 'x')).status, 200)
      << "small ones always pass";
  first.send(std::string(1000, 'x'));
  EXPECT_EQ(receive_reply(first).status, 200);
  EXPECT_EQ(http_request(port, "POST", "/echo", std::string(1000, 'x')).status, 200);
}

TEST_F(ListenerTest, HandlersSeeWhoAsksAndThatItIsPlain) {
  router.on("GET", "/peer", [](const Request& request) {
    return bytes_response(200, "text/plain",
                          share(request.peer + (request.encrypted ? " encrypted" : " plain")));
  });
  EXPECT_EQ(http_request(start(), "GET", "/peer").body, "127.0.0.1 plain");
}

TEST_F(ListenerTest, BeyondLoopbackItAnswersByItsAddressAndItsPublicNames) {
  options.beyond_loopback = true;
  options.host = "0.0.0.0";
  options.public_names = {"Ream.Example.org"};
  const uint16_t port = start();
  EXPECT_EQ(http_request(port, "GET", "/hello").status, 200);
  EXPECT_EQ(http_request(port, "GET", "/hello", "", {{"Host", "ream.example.org:8443"}}).status, 200);
  EXPECT_EQ(http_request(port, "GET", "/hello", "", {{"Host", "evil.example"}}).status, 421);
}

TEST_F(ListenerTest, HostMustBeAnAddress) {
  options.beyond_loopback = true;
  options.host = "ream.example.org";
  test::expect_error(ErrorKind::usage, "--public-name", [&] { Listener(router, options); });
  options.host = "127.0.0.1";
  options.public_names = {"https://ream.example.org"};
  test::expect_error(ErrorKind::usage, "without https://", [&] { Listener(router, options); });
}

TEST_F(ListenerTest, PortInUseNamesPortAndWayOut) {
  options.port = start();
  try {
    const Listener second(router, options);
    FAIL() << "bound twice";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::unavailable);
    EXPECT_EQ(std::string(error.what()),
              "port " + std::to_string(options.port) + " on 127.0.0.1 is in use; choose another with --port");
  }
}

TEST_F(ListenerTest, OtherThanLoopbackIsRefused) {
  for (const char* host : {"0.0.0.0", "::", "192.168.1.1", "example.org"}) {
    options.host = host;
    try {
      const Listener refused(router, options);
      FAIL() << host;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage) << host;
    }
  }
}

TEST_F(ListenerTest, StopEndsIdleConnectionsAndLetsRequestsFinish) {
  const uint16_t port = start();
  RawSocket idle(port), busy(port);
  busy.send(get_line("/wait"));
  waiting.get_future().wait();
  auto stopping = std::async(std::launch::async, [&] { listener->stop(); });
  EXPECT_EQ(idle.receive_all(), "");
  release.set_value();
  EXPECT_EQ(receive_reply(busy).body, "late");
  EXPECT_EQ(busy.receive_all(), "");
  stopping.get();
  EXPECT_THROW(RawSocket{port}, std::runtime_error);
}

TEST_F(ListenerTest, StopCutsThoseWhoDoNotRead) {
  options.limits.stop = 200ms;
  const uint16_t port = start();
  RawSocket slow(port, 4096);
  slow.send(get_line("/large"));
  slow.receive_until("\r\n\r\n");
  listener->stop();
  EXPECT_LT(slow.receive_all().size(), large->size());
}

}  // namespace
}  // namespace ream::net
