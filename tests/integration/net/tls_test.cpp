#include "net/tls.hpp"

#include <gtest/gtest.h>
#include <openssl/ssl.h>

#include <fstream>
#include <thread>

#include "core/file.hpp"
#include "net/listener.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_certificate.hpp"
#include "support/tls_socket.hpp"

namespace ream::net {
namespace {

using test::expect_error;
using test::RawSocket;
using test::RawWebSocket;
using test::TlsSocket;
using namespace std::chrono_literals;

class TlsFilesTest : public testing::Test {
 protected:
  TlsFilesTest() { test::make_certificate(files.certificate_chain, files.key); }
  const test::TemporaryFolder folder;
  const TlsOptions files{folder.path() / "server.pem", folder.path() / "server.key"};
};

TEST_F(TlsFilesTest, GoodFilesAreTaken) {
  EXPECT_NO_THROW(TlsContext{files});
  test::make_certificate(files.certificate_chain, files.key, {-1, 30, 2048});
  EXPECT_NO_THROW(TlsContext{files});
  std::ofstream(files.certificate_chain, std::ios::app) << read_text_file(files.certificate_chain);
  EXPECT_NO_THROW(TlsContext{files}) << "with a chain";
}

TEST_F(TlsFilesTest, FilesThatWereReplacedAreReadAnew) {
  RenewedTls tls(files);
  const auto first = tls.current();
  tls.look();
  EXPECT_EQ(tls.current(), first) << "nothing has changed";
  const std::string key = read_text_file(files.key), chain = read_text_file(files.certificate_chain);
  test::make_certificate(files.certificate_chain, folder.path() / "other.key");
  tls.look();
  EXPECT_EQ(tls.current(), first) << "the key is still the old one";
  std::filesystem::rename(folder.path() / "other.key", files.key);
  tls.look();
  const auto second = tls.current();
  EXPECT_NE(second, first);
  std::filesystem::remove(files.key);
  tls.look();
  std::ofstream(files.key) << "nonsense";
  tls.look();
  EXPECT_EQ(tls.current(), second);
  std::ofstream(files.key) << key;
  std::ofstream(files.certificate_chain) << chain;
  tls.look();
  EXPECT_NE(tls.current(), second);
}

TEST_F(TlsFilesTest, MissingFilesAreNamed) {
  expect_error(ErrorKind::not_found, "none.pem", [&] {
    TlsContext({folder.path() / "none.pem", files.key});
  });
  expect_error(ErrorKind::not_found, "none.key", [&] {
    TlsContext({files.certificate_chain, folder.path() / "none.key"});
  });
  expect_error(ErrorKind::invalid_input, "folder", [&] { TlsContext({folder.path(), files.key}); });
}

TEST_F(TlsFilesTest, FilesThatHoldSomethingElseAreNamed) {
  const auto other = folder.write("other.txt", "hello\n"), empty = folder.write("empty", "");
  expect_error(ErrorKind::invalid_input, "other.txt holds no certificate", [&] {
    TlsContext({other, files.key});
  });
  expect_error(ErrorKind::invalid_input, "empty holds no certificate", [&] {
    TlsContext({empty, files.key});
  });
  expect_error(ErrorKind::invalid_input, "other.txt holds no private key", [&] {
    TlsContext({files.certificate_chain, other});
  });
  expect_error(ErrorKind::invalid_input, "server.pem holds no private key", [&] {
    TlsContext({files.certificate_chain, files.certificate_chain});
  });
  const std::string whole = read_text_file(files.certificate_chain);
  const auto cut = folder.write("cut.pem", whole.substr(0, whole.size() / 2));
  expect_error(ErrorKind::invalid_input, "cut.pem holds no certificate", [&] {
    TlsContext({cut, files.key});
  });
}

TEST_F(TlsFilesTest, KeyOfAnotherCertificateIsRefused) {
  test::make_certificate(folder.path() / "b.pem", folder.path() / "b.key");
  expect_error(ErrorKind::invalid_input, "b.key is not the key of the certificate in", [&] {
    TlsContext({files.certificate_chain, folder.path() / "b.key"});
  });
}

TEST_F(TlsFilesTest, CertificateMustBeValidToday) {
  test::make_certificate(files.certificate_chain, files.key, {-20, -10});
  expect_error(ErrorKind::invalid_input, "server.pem has expired", [&] { TlsContext{files}; });
  test::make_certificate(files.certificate_chain, files.key, {5, 10});
  expect_error(ErrorKind::invalid_input, "server.pem is not valid before", [&] { TlsContext{files}; });
}

TEST_F(TlsFilesTest, WeakKeyIsRefused) {
  test::make_certificate(files.certificate_chain, files.key, {-1, 30, 1024});
  expect_error(ErrorKind::invalid_input, "too weak", [&] { TlsContext{files}; });
}

TEST_F(TlsFilesTest, KeyWithAPassPhraseIsRefusedWithoutAsking) {
  folder.write("server.key",
               "-----BEGIN ENCRYPTED PRIVATE KEY-----\nMIGbMFcGCSqGSIb3DQEFDTBKMCkGCSqGSIb3DQEFDDAcBAjHq8i4\n"
               "-----END ENCRYPTED PRIVATE KEY-----\n");
  expect_error(ErrorKind::invalid_input, "without a pass phrase", [&] { TlsContext{files}; });
}

/// Sends back what it hears.
class Echo final : public WebSocketSession {
 public:
  void on_open(std::function<void()> wake) override { wake_ = std::move(wake); }
  std::optional<SharedBytes> next() override { return std::exchange(waiting_, std::nullopt); }
  void on_message(std::span<const std::byte> message) override {
    waiting_ = std::make_shared<const Bytes>(message.begin(), message.end());
    wake_();
  }
  void on_close() noexcept override {}

 private:
  std::optional<SharedBytes> waiting_;
  std::function<void()> wake_;
};

class TlsTest : public TlsFilesTest {
 protected:
  TlsTest() {
    router.on("GET", "/hello", [](const Request& request) {
      return bytes_response(200, "text/plain", share(request.encrypted ? "encrypted" : "plain"));
    });
    router.on("POST", "/echo",
              [](const Request& request) { return bytes_response(200, "text/plain", share(request.body)); });
    router.on("GET", "/large", [this](const Request&) { return bytes_response(200, "text/plain", large); });
    router.on_websocket("/echo", [](const Request&) { return std::make_unique<Echo>(); });
    options.port = 0;
    options.tls = files;
  }
  uint16_t start() {
    listener = std::make_unique<Listener>(router, options);
    listener->start();
    return listener->port();
  }
  test::HttpReply get(uint16_t port, const std::string& path,
                      const std::map<std::string, std::string>& headers = {}) {
    TlsSocket socket(port);
    return http_request(socket, port, "GET", path, "", headers);
  }

  const SharedBytes large = std::make_shared<const Bytes>(8u << 20, std::byte{'x'});
  Router router;
  ListenOptions options;
  std::unique_ptr<Listener> listener;
};

TEST_F(TlsTest, AnswersAndAsksBrowsersToComeBackWithTls) {
  const test::HttpReply reply = get(start(), "/hello");
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.body, "encrypted");
  EXPECT_EQ(reply.headers.at("strict-transport-security"), "max-age=31536000");
}

TEST_F(TlsTest, LargeBodiesGoBothWaysOverOneConnection) {
  const uint16_t port = start();
  TlsSocket socket(port);
  const std::string body(700'000, 'b');
  const std::map<std::string, std::string> keep{{"Connection", "keep-alive"}};
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(http_request(socket, port, "POST", "/echo", body, keep).body, body);
    EXPECT_EQ(http_request(socket, port, "GET", "/large", "", keep).body.size(), large->size());
  }
}

TEST_F(TlsTest, WebSocketRunsOverIt) {
  const uint16_t port = start();
  RawWebSocket client(std::make_unique<TlsSocket>(port), port, "/echo");
  ASSERT_EQ(client.handshake().status, 101);
  for (int i = 0; i < 100; ++i) {
    client.send_binary(std::string(static_cast<size_t>(i) * 100, 'm'));
    EXPECT_EQ(client.receive().payload.size(), static_cast<size_t>(i) * 100);
  }
  client.send_close(1000);
  EXPECT_EQ(client.receive().close_code(), 1000);
  EXPECT_EQ(client.socket().receive_all(), "");
}

TEST_F(TlsTest, OriginMustBeHttps) {
  const uint16_t port = start();
  const std::string host = "127.0.0.1:" + std::to_string(port);
  EXPECT_EQ(RawWebSocket(std::make_unique<TlsSocket>(port), port, "/echo", {{"Origin", "https://" + host}})
                .handshake()
                .status,
            101);
  EXPECT_EQ(RawWebSocket(std::make_unique<TlsSocket>(port), port, "/echo", {{"Origin", "http://" + host}})
                .handshake()
                .status,
            403);
}

TEST_F(TlsTest, OldVersionsAndCiphersAreRefused) {
  const uint16_t port = start();
  EXPECT_EQ(TlsSocket(port).version(), "TLSv1.3");
  const TlsSocket older(port, {TLS1_2_VERSION, {}});
  EXPECT_EQ(older.version(), "TLSv1.2");
  EXPECT_TRUE(older.cipher().starts_with("ECDHE-")) << older.cipher();
  EXPECT_THROW(TlsSocket(port, {TLS1_1_VERSION, {}}), std::runtime_error);
  for (const char* weak :
       {"AES128-SHA", "AES256-GCM-SHA384", "ECDHE-ECDSA-AES128-SHA", "NULL-SHA256", "aNULL"})
    EXPECT_THROW(TlsSocket(port, {TLS1_2_VERSION, weak}), std::runtime_error) << weak;
}

TEST_F(TlsTest, PlainHttpIsToldToUseHttps) {
  const uint16_t port = start();
  const test::HttpReply reply = test::http_request(port, "GET", "/hello");
  EXPECT_EQ(reply.status, 400);
  EXPECT_NE(reply.body.find("https://"), std::string::npos);
  EXPECT_EQ(reply.headers.count("strict-transport-security"), 0u);
  EXPECT_EQ(get(port, "/hello").status, 200);
}

TEST_F(TlsTest, HandshakeThatDoesNotComeIsCutInTime) {
  options.limits.header = 200ms;
  const uint16_t port = start();
  RawSocket silent(port), half(port), garbage(port);
  half.send(std::string("\x16\x03\x01\x02", 4));
  garbage.send("\x16" + std::string(600, 'x'));
  EXPECT_EQ(silent.receive_all(), "");
  EXPECT_EQ(half.receive_all(), "");
  garbage.receive_all();
  EXPECT_EQ(get(port, "/hello").status, 200);
}

TEST_F(TlsTest, HandshakesCostMoreThanRequests) {
  options.limits.requests_per_address = {0.001, 25.0};
  options.limits.handshake_cost = 10.0;
  const uint16_t port = start();
  EXPECT_EQ(get(port, "/hello").status, 200);
  EXPECT_EQ(get(port, "/hello").status, 200);
  EXPECT_THROW(TlsSocket{port}, std::runtime_error);
}

TEST_F(TlsTest, StopEndsIdleConnections) {
  const uint16_t port = start();
  TlsSocket idle(port);
  EXPECT_EQ(http_request(idle, port, "GET", "/hello", "", {{"Connection", "keep-alive"}}).status, 200);
  RawWebSocket socket(std::make_unique<TlsSocket>(port), port, "/echo");
  socket.send_binary("are you there");
  EXPECT_EQ(socket.receive().payload, "are you there");
  std::thread stopping([this] { listener->stop(); });
  EXPECT_EQ(socket.receive().close_code(), 1001);
  socket.send_close(1001);
  EXPECT_EQ(idle.receive_all(), "");
  stopping.join();
}

TEST_F(TlsTest, BadCertificateLeavesThePortFree) {
  options.port = start();
  listener.reset();
  TlsOptions bad = files;
  bad.key = folder.path() / "none.key";
  options.tls = bad;
  EXPECT_THROW(Listener(router, options), Error);
  options.tls = files;
  EXPECT_EQ(get(start(), "/hello").status, 200);
}

}  // namespace
}  // namespace ream::net
