#include "net/guard.hpp"

#include <gtest/gtest.h>

namespace ream::net {
namespace {

int refusal(const std::string& method, const std::string& host, const std::string& origin,
            bool websocket = false) {
  Request request;
  request.method = method;
  if (!host.empty()) request.headers["host"] = host;
  if (!origin.empty()) request.headers["origin"] = origin;
  const auto response = refuse_foreign(request, websocket);
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

}  // namespace
}  // namespace ream::net
