#include "net/client_address.hpp"

#include <gtest/gtest.h>

#include "net/problem.hpp"
#include "support/expect_error.hpp"

namespace ream::net {
namespace {

using Headers = std::map<std::string, std::string>;

TrustedProxies proxies(const std::vector<std::string>& texts) {
  std::vector<TrustedProxy> made;
  for (const std::string& text : texts) made.push_back(trusted_proxy(text));
  return TrustedProxies(made);
}

Request resolved(const std::vector<std::string>& trusted, const std::string& peer, const Headers& headers,
                 bool encrypted = false) {
  Request request;
  request.headers = headers;
  proxies(trusted).resolve(request, peer, encrypted);
  return request;
}

std::string client(const std::vector<std::string>& trusted, const std::string& peer, const Headers& headers) {
  return resolved(trusted, peer, headers).peer;
}

TEST(TrustedProxy, IsAnAddressOrANetwork) {
  EXPECT_TRUE(proxies({"10.0.0.7"}).trusts("10.0.0.7"));
  EXPECT_TRUE(proxies({"10.0.0.7"}).trusts("::ffff:10.0.0.7"));
  EXPECT_FALSE(proxies({"10.0.0.7"}).trusts("10.0.0.8"));
  EXPECT_TRUE(proxies({"10.0.0.0/9"}).trusts("10.127.255.255"));
  EXPECT_FALSE(proxies({"10.0.0.0/9"}).trusts("10.128.0.0"));
  EXPECT_TRUE(proxies({"2001:db8::/33"}).trusts("2001:db8:7fff::1"));
  EXPECT_FALSE(proxies({"2001:db8::/33"}).trusts("2001:db8:8000::1"));
  EXPECT_TRUE(proxies({"0.0.0.0/0"}).trusts("1.2.3.4"));
  EXPECT_FALSE(proxies({"0.0.0.0/0"}).trusts("2001:db8::1")) << "all of IPv4 only";
  EXPECT_FALSE(proxies({"::1"}).trusts("127.0.0.1"));
  EXPECT_FALSE(proxies({}).trusts("127.0.0.1"));
  EXPECT_FALSE(proxies({"::/0"}).trusts("nonsense"));
}

TEST(TrustedProxy, IsNothingElse) {
  for (const char* text : {"", "proxy.example", "10.0.0.7/33", "10.0.0.7/-1", "10.0.0.7/", "10.0.0.7/8x",
                           "::1/129", "10.0.0", "10.0.0.7:80", "[::1]"})
    test::expect_error(ErrorKind::usage, "--trusted-proxy", [&] { trusted_proxy(text); });
}

TEST(ClientAddress, HeadersOfStrangersSayNothing) {
  const Headers lies{{"x-forwarded-for", "1.2.3.4"},
                     {"forwarded", "for=1.2.3.4;proto=https"},
                     {"x-forwarded-proto", "https"}};
  const Request request = resolved({"10.0.0.7"}, "10.0.0.8", lies);
  EXPECT_EQ(request.peer, "10.0.0.8");
  EXPECT_FALSE(request.encrypted);
  EXPECT_TRUE(request.passed_on);
  EXPECT_EQ(client({}, "127.0.0.1", lies), "127.0.0.1");
}

TEST(ClientAddress, IsTheLastHopThatIsNoTrustedProxy) {
  const auto seen = [](const std::string& chain) {
    return client({"10.0.0.0/8"}, "10.0.0.7", {{"x-forwarded-for", chain}});
  };
  EXPECT_EQ(seen("1.2.3.4"), "1.2.3.4");
  EXPECT_EQ(seen("6.6.6.6, 1.2.3.4"), "1.2.3.4") << "what clients send stands to the left";
  EXPECT_EQ(seen("6.6.6.6, 1.2.3.4, 10.0.0.9"), "1.2.3.4");
  EXPECT_EQ(seen("10.0.0.1, 10.0.0.2"), "10.0.0.1");
  EXPECT_EQ(seen("1.2.3.4:5678"), "1.2.3.4");
  EXPECT_EQ(seen("[2001:db8::1]:5678"), "2001:db8::1");
  EXPECT_EQ(seen("2001:DB8:0::1"), "2001:db8::1");
  EXPECT_EQ(seen("::ffff:1.2.3.4"), "1.2.3.4");
  EXPECT_EQ(seen("1.2.3.4, unknown"), "10.0.0.7") << "the proxy does not say";
  EXPECT_EQ(seen("1.2.3.4, unknown, 10.0.0.9"), "10.0.0.9");
  EXPECT_EQ(seen("1.2.3.4,"), "10.0.0.7");
  EXPECT_EQ(seen("127.0.0.1"), "127.0.0.1");
}

TEST(ClientAddress, ForwardedIsReadAsRfc7239SaysIt) {
  const auto seen = [](const std::string& header) {
    return resolved({"10.0.0.0/8"}, "10.0.0.7", {{"forwarded", header}});
  };
  EXPECT_EQ(seen("for=1.2.3.4").peer, "1.2.3.4");
  EXPECT_EQ(seen("For=\"[2001:db8::1]:47\";proto=https;by=10.0.0.7").peer, "2001:db8::1");
  EXPECT_TRUE(seen("For=\"[2001:db8::1]:47\";Proto=HTTPS").encrypted);
  EXPECT_EQ(seen("for=6.6.6.6;proto=https, for=1.2.3.4;proto=http, for=10.0.0.9").peer, "1.2.3.4");
  EXPECT_FALSE(seen("for=6.6.6.6;proto=https, for=1.2.3.4;proto=http, for=10.0.0.9").encrypted);
  EXPECT_EQ(seen("for=1.2.3.4;by=\"a,b;for=6.6.6.6\"").peer, "1.2.3.4") << "what is quoted parts nothing";
  EXPECT_EQ(seen("for=_hidden").peer, "10.0.0.7");
  EXPECT_EQ(seen("by=10.0.0.7").peer, "10.0.0.7");
}

TEST(ClientAddress, TheSchemeIsTheClients) {
  const auto encrypted = [](const Headers& headers) {
    return resolved({"10.0.0.7"}, "10.0.0.7", headers).encrypted;
  };
  EXPECT_TRUE(encrypted({{"x-forwarded-for", "1.2.3.4"}, {"x-forwarded-proto", "https"}}));
  EXPECT_TRUE(encrypted({{"x-forwarded-proto", "https"}}));
  EXPECT_FALSE(encrypted({{"x-forwarded-for", "1.2.3.4"}, {"x-forwarded-proto", "http"}}));
  EXPECT_FALSE(encrypted({{"x-forwarded-for", "1.2.3.4"}}));
  EXPECT_TRUE(encrypted({{"x-forwarded-for", "1.2.3.4, 10.0.0.7"}, {"x-forwarded-proto", "https, http"}}))
      << "each hop has its own";
  EXPECT_TRUE(resolved({"10.0.0.7"}, "10.0.0.7", {}, true).encrypted) << "came here over TLS";
}

TEST(ClientAddress, TwoHeadersThatDifferAreRefused) {
  const auto asked = [](const Headers& headers) { resolved({"10.0.0.7"}, "10.0.0.7", headers); };
  EXPECT_NO_THROW(asked({{"x-forwarded-for", "1.2.3.4"}, {"forwarded", "for=1.2.3.4;proto=https"}}));
  for (const char* invented : {"for=6.6.6.6", "for=unknown", "proto=https"})
    EXPECT_THROW(asked({{"x-forwarded-for", "1.2.3.4"}, {"forwarded", invented}}), RequestError) << invented;
  EXPECT_THROW(asked({{"x-forwarded-for", "1.2.3.4"},
                      {"x-forwarded-proto", "http"},
                      {"forwarded", "for=1.2.3.4;proto=https"}}),
               RequestError);
}

TEST(ClientAddress, WhatWasPassedOnIsSeen) {
  for (const char* name : {"forwarded", "via", "x-real-ip", "x-forwarded-for", "x-forwarded-host",
                           "x-forwarded-proto", "true-client-ip", "cf-connecting-ip"})
    EXPECT_TRUE(resolved({}, "127.0.0.1", {{name, ""}}).passed_on) << name;
  EXPECT_FALSE(resolved({}, "127.0.0.1", {{"host", "localhost"}, {"x-other", "1"}}).passed_on);
  EXPECT_TRUE(resolved({"127.0.0.1"}, "127.0.0.1", {}).passed_on) << "a proxy that says nothing";
}

TEST(ClientAddress, LimitsGoByNetworksOfIpv6) {
  EXPECT_EQ(limit_key("10.0.0.7"), "10.0.0.7");
  EXPECT_EQ(limit_key("2001:db8:1:2:3:4:5:6"), "2001:db8:1:2::/64");
  EXPECT_EQ(limit_key("nowhere"), "nowhere");
}

}  // namespace
}  // namespace ream::net
