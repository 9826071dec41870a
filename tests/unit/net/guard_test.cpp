#include "net/guard.hpp"

#include <gtest/gtest.h>

#include "support/expect_error.hpp"

namespace ream::net {
namespace {

struct Shown {
  std::string local = "127.0.0.1";
  std::vector<std::string> public_names = {};
  bool encrypted = false;
};

int refusal(const std::string& method, const std::string& host, const std::string& origin,
            bool websocket = false, const Shown& server = {}) {
  Request request;
  request.encrypted = server.encrypted;
  request.method = method;
  if (!host.empty()) request.headers["host"] = host;
  if (!origin.empty()) request.headers["origin"] = origin;
  const auto response = refuse_foreign(request, websocket, {server.public_names, server.local});
  return response ? response->status : 0;
}

TEST(Guard, LoopbackOnly) {
  for (const char* host : {"127.0.0.1", "127.8.9.1", "::1", "localhost", "LocalHost"})
    EXPECT_TRUE(is_loopback_host(host)) << host;
  for (const char* host :
       {"", "0.0.0.0", "::", "192.168.1.4", "127.0.0.1.example.org", "localhost.example.org", "127.1", "*"})
    EXPECT_FALSE(is_loopback_host(host)) << host;
}

TEST(Guard, HostMustNameThisMachine) {
  for (const char* host : {"localhost", "localhost:8080", "127.0.0.1:1", "[::1]", "[::1]:8080"})
    EXPECT_EQ(refusal("GET", host, ""), 0) << host;
  for (const char* host : {"", "evil.example", "evil.example:8080", "localhost:80:80", "localhost:",
                           "localhost:x", "[::1", "[::1]x", "192.168.0.2:8080", "localhost, evil.example"})
    EXPECT_EQ(refusal("GET", host, ""), 421) << host;
}

TEST(Guard, OtherOriginsMayNeitherChangeNorListen) {
  EXPECT_EQ(refusal("POST", "localhost:8080", "http://localhost:8080"), 0);
  EXPECT_EQ(refusal("POST", "localhost:8080", ""), 0);
  EXPECT_EQ(refusal("POST", "localhost:8080", "http://localhost:9999"), 403);
  EXPECT_EQ(refusal("POST", "localhost:8080", "https://evil.example"), 403);
  EXPECT_EQ(refusal("POST", "localhost:8080", "null"), 403);
  EXPECT_EQ(refusal("GET", "localhost:8080", "https://evil.example"), 0);
  EXPECT_EQ(refusal("GET", "localhost:8080", "https://evil.example", true), 403);
  EXPECT_EQ(refusal("GET", "localhost:8080", "http://localhost:8080", true), 0);
}

TEST(Guard, BeyondLoopbackTheHostIsTheAddressThatWasReachedOrAPublicName) {
  const Shown server{"192.168.1.4", {"ream.example.org", "203.0.113.7"}};
  for (const char* host : {"192.168.1.4", "192.168.1.4:8443", "ream.example.org", "REAM.Example.org:8443",
                           "203.0.113.7", "localhost:8443", "127.0.0.1"})
    EXPECT_EQ(refusal("GET", host, "", false, server), 0) << host;
  for (const char* host :
       {"", "192.168.1.5", "evil.example", "ream.example.org.evil.example", "ream.example.org.",
        "192.168.1.4.evil.example", "203.0.113.8", "192.168.1.4@evil.example", "0.0.0.0"})
    EXPECT_EQ(refusal("GET", host, "", false, server), 421) << host;
  const Shown six{"2001:db8::1", {}};
  EXPECT_EQ(refusal("GET", "[2001:DB8:0:0::1]:8443", "", false, six), 0);
  EXPECT_EQ(refusal("GET", "[2001:db8::2]:8443", "", false, six), 421);
}

TEST(Guard, OriginHasTheSchemeOfTheConnection) {
  const Shown plain{"192.168.1.4", {"ream.example.org"}};
  Shown encrypted = plain;
  encrypted.encrypted = true;
  EXPECT_EQ(refusal("POST", "ream.example.org", "https://ream.example.org", false, encrypted), 0);
  EXPECT_EQ(refusal("POST", "ream.example.org", "http://ream.example.org", false, encrypted), 403);
  EXPECT_EQ(refusal("GET", "ream.example.org", "http://ream.example.org", true, encrypted), 403);
  EXPECT_EQ(refusal("POST", "ream.example.org", "http://ream.example.org", false, plain), 0);
  EXPECT_EQ(refusal("POST", "ream.example.org", "https://ream.example.org", false, plain), 0);
  EXPECT_EQ(refusal("POST", "192.168.1.4", "http://ream.example.org", false, plain), 403);
}

TEST(Guard, PublicNamesAreNamesOrAddressesAlone) {
  EXPECT_EQ(plain_host("Ream.Example.ORG"), "ream.example.org");
  EXPECT_EQ(plain_host("[2001:DB8::0:1]"), "2001:db8::1");
  EXPECT_EQ(plain_host("203.0.113.7"), "203.0.113.7");
  for (const char* name : {"", "https://ream.example.org", "ream.example.org:8443", "ream.example.org/",
                           "a b", "*", "[]", "[::1]:80", "a,b", "user@host"})
    test::expect_error(ErrorKind::usage, name, [&] { plain_host(name); });
}

TEST(Guard, SecurityHeadersForbidWhatThePageDoesNotNeed) {
  const auto text_of = [](bool encrypted) {
    std::string text;
    for (const auto& [name, value] : security_headers(encrypted)) text += name + ": " + value + "\n";
    return text;
  };
  for (const char* part :
       {"default-src 'self'", "frame-ancestors 'none'", "object-src 'none'", "base-uri 'none'",
        "X-Content-Type-Options: nosniff", "Referrer-Policy: no-referrer", "camera=()"})
    EXPECT_NE(text_of(false).find(part), std::string::npos) << part;
  EXPECT_EQ(text_of(false).find("unsafe-inline"), std::string::npos);
  EXPECT_EQ(text_of(false).find("Strict-Transport-Security"), std::string::npos);
  EXPECT_NE(text_of(true).find("Strict-Transport-Security: max-age=31536000"), std::string::npos);
}

}  // namespace
}  // namespace ream::net
