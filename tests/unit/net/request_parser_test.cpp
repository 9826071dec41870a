#include "net/request_parser.hpp"

#include <gtest/gtest.h>

#include <random>

#include "net/problem.hpp"
#include "support/seed.hpp"

namespace ream::net {
namespace {

using Stage = RequestParser::Stage;

class RequestParserTest : public testing::Test {
 protected:
  RequestParserTest() { limits.body_bytes = 1000; }

  /// Status of the refusal; 0 when the request is whole, -1 when more of it is awaited.
  int status_of(const std::string& bytes) const {
    try {
      RequestParser parser(limits);
      parser.feed(bytes);
      return parser.stage() == Stage::whole ? 0 : -1;
    } catch (const RequestError& error) {
      return error.status();
    }
  }
  int status_with(const std::string& lines, const std::string& body = {}) const {
    return status_of("POST /x HTTP/1.1\r\nHost: localhost\r\n" + lines + "\r\n" + body);
  }

  Limits limits;
};

TEST_F(RequestParserTest, ReadsMethodTargetHeadersAndBody) {
  RequestParser parser(limits);
  parser.feed(
      "PUT /a%20b?c=d HTTP/1.1\r\nHost: localhost\r\nX-Two: 1\r\nx-two: 2\r\nContent-Length: 3\r\n\r\nabc");
  ASSERT_EQ(parser.stage(), Stage::whole);
  EXPECT_EQ(parser.request().method, "PUT");
  EXPECT_EQ(parser.request().path, "/a b");
  EXPECT_EQ(parser.request().query.at("c"), "d");
  EXPECT_EQ(parser.request().header("x-two"), "1, 2");
  EXPECT_EQ(parser.take_body(), "abc");
  EXPECT_TRUE(parser.keep_alive());
  EXPECT_EQ(parser.announced_bytes(), 3u);
}

TEST_F(RequestParserTest, OlderVersionEndsTheConnection) {
  RequestParser parser(limits);
  parser.feed("GET / HTTP/1.0\r\nHost: localhost\r\nConnection: keep-alive\r\nExpect: 100-continue\r\n\r\n");
  EXPECT_EQ(parser.stage(), Stage::whole);
  EXPECT_FALSE(parser.keep_alive());
  EXPECT_FALSE(parser.wants_continue());
}

TEST_F(RequestParserTest, ChunkedBodyWithTrailersThatChangeNothing) {
  RequestParser parser(limits);
  parser.feed(
      "POST / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n"
      "3;ext=1\r\nabc\r\nA\r\n0123456789\r\n0\r\nCookie: late\r\nHost: evil.example\r\n\r\n");
  ASSERT_EQ(parser.stage(), Stage::whole);
  EXPECT_EQ(parser.take_body(), "abc0123456789");
  EXPECT_EQ(parser.request().header("host"), "localhost");
  EXPECT_EQ(parser.request().header("cookie"), "");
  EXPECT_EQ(parser.announced_bytes(), std::nullopt);
}

/// The library's own check ended the program where the line of the last chunk came, and then a byte or two.
TEST_F(RequestParserTest, AnEmptyChunkedBodyMayComeInAnyPieces) {
  const std::string head = "POST / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n";
  for (const std::string body : {"0\r\n\r\n", "0\r\nX: y\r\n\r\n", "0;a=b\r\n\r\n", "1\r\nz\r\n0\r\n\r\n"})
    for (size_t first = 1; first < body.size(); ++first)
      for (size_t second = first; second < body.size(); ++second) {
        RequestParser parser(limits);
        parser.feed(head);
        for (const std::string& piece :
             {body.substr(0, first), body.substr(first, second - first), body.substr(second)})
          parser.feed(piece);
        EXPECT_EQ(parser.stage(), Stage::whole) << body << " cut at " << first << " and " << second;
      }
}

/// Three requests in one stream, however it is cut.
TEST_F(RequestParserTest, ReadsTheSameHoweverTheBytesAreCut) {
  const std::string stream =
      "POST /one HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5\r\n\r\nfirst"
      "POST /two HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n6\r\nsecond\r\n0\r\nX: "
      "y\r\n\r\n"
      "GET /three HTTP/1.1\r\nHost: localhost\r\n\r\n";
  std::mt19937 random(test::seed());
  for (int round = 0; round < 200; ++round) {
    const size_t most = round == 0 ? 1 : round == 1 ? stream.size() : 1 + random() % 20;
    RequestParser parser(limits);
    std::string seen;
    for (size_t at = 0; at < stream.size();) {
      const size_t n = std::min(stream.size() - at, round < 2 ? most : 1 + random() % most);
      parser.feed(std::string_view(stream).substr(at, n));
      at += n;
      while (parser.stage() == Stage::whole) {
        seen += parser.request().path + "=" + parser.take_body() + ";";
        parser.next();
      }
    }
    EXPECT_EQ(seen, "/one=first;/two=second;/three=;");
    EXPECT_EQ(parser.stage(), Stage::nothing);
  }
}

TEST_F(RequestParserTest, WhatTwoReadersCouldReadDifferentlyIsRefused) {
  EXPECT_EQ(status_with("Content-Length: 3\r\n", "abc"), 0);
  for (const char* lines : {"Content-Length: 3\r\nContent-Length: 3\r\n",
                            "Content-Length: 3\r\nContent-Length: 4\r\n",
                            "Content-Length: 3, 3\r\n",
                            "Content-Length: +3\r\n",
                            "Content-Length: 0x3\r\n",
                            "Content-Length: -1\r\n",
                            "Content-Length: 99999999999999999999999\r\n",
                            "Content-Length:\r\n",
                            "Content-Length: 3\r\nTransfer-Encoding: chunked\r\n",
                            "Transfer-Encoding: chunked\r\nContent-Length: 3\r\n",
                            "Transfer-Encoding: gzip, chunked\r\n",
                            "Transfer-Encoding: chunked, identity\r\n",
                            "Transfer-Encoding: xchunked\r\n",
                            "Transfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n",
                            "Transfer-Encoding: \"chunked\"\r\n",
                            "Transfer-Encoding: identity\r\n",
                            "Host: other\r\n",
                            "Content-Length : 3\r\n",
                            " Content-Length: 3\r\n",
                            "X: a\r\n b\r\n",
                            "X: a\r\n\tContent-Length: 3\r\n",
                            "X: a\rContent-Length: 3\r\n",
                            "X: a\nContent-Length: 3\r\n",
                            "X: a\r\r\n",
                            "X\r\n",
                            ": x\r\n",
                            "X Y: z\r\n",
                            "X\x01: y\r\n",
                            "X: \x7f\r\n"})
    EXPECT_EQ(status_with(lines, "abc"), 400) << lines;
  EXPECT_EQ(status_with(std::string("X: a\0b\r\n", 8)), 400);
  EXPECT_EQ(status_of("POST / HTTP/1.0\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n"),
            400);
}

TEST_F(RequestParserTest, WhatIsNoRequestLineIsRefused) {
  for (const char* line :
       {"GET / HTTP/2.0", "GET / HTTP/0.9", "GET /", "GET", "GET  / HTTP/1.1", "GET / http/1.1",
        " GET / HTTP/1.1", "G(T / HTTP/1.1", "GET /a b HTTP/1.1", "GET http://localhost/ HTTP/1.1",
        "OPTIONS * HTTP/1.1", "CONNECT localhost:1 HTTP/1.1", "GET /\x80 HTTP/1.1\x80", "PRI * HTTP/2.0"})
    EXPECT_EQ(status_of(std::string(line) + "\r\nHost: localhost\r\n\r\n"), 400) << line;
  EXPECT_EQ(status_of("\r\n\r\n"), 400);
  EXPECT_EQ(status_of(std::string("\x16\x03\x01", 3)), 400);
}

TEST_F(RequestParserTest, SizesAreBounded) {
  EXPECT_EQ(
      status_of("GET /" + std::string(limits.target_bytes, 'a') + " HTTP/1.1\r\nHost: localhost\r\n\r\n"),
      414);
  EXPECT_EQ(status_with("X: " + std::string(limits.header_line_bytes, 'a') + "\r\n"), 431);
  std::string lines;
  for (size_t i = 0; i < limits.header_lines; ++i) lines += "X: y\r\n";
  EXPECT_EQ(status_with(lines), 431);
  EXPECT_EQ(status_of("GET / HTTP/1.1\r\n" + std::string(limits.header_bytes, 'a')), 431);
  EXPECT_EQ(status_of(std::string(limits.header_bytes + 1, 'a')), 431);
  EXPECT_EQ(status_with("Content-Length: 1001\r\n"), 413);
  EXPECT_EQ(status_with("Content-Length: 1000\r\n"), -1);
}

TEST_F(RequestParserTest, ChunksAreBounded) {
  const std::string coding = "Transfer-Encoding: chunked\r\n";
  EXPECT_EQ(status_with(coding, "3e9\r\n"), 413);
  EXPECT_EQ(status_with(coding, "3e0\r\n" + std::string(992, 'x') + "\r\n9\r\n"), 413);
  EXPECT_EQ(status_with(coding, "ffffffffffffffffff\r\n"), 400);
  EXPECT_EQ(status_with(coding, "zz\r\n"), 400);
  EXPECT_EQ(status_with(coding, "1\nx\n0\r\n"), 400);
  EXPECT_EQ(status_with(coding, "1\r\nxy\r\n0\r\n\r\n"), 400);
  EXPECT_EQ(status_with(coding, "1;" + std::string(10'000, 'e')), 400);
  EXPECT_EQ(status_with(coding, "0\r\nX: " + std::string(10'000, 'e')), 400);
  EXPECT_EQ(status_with(coding, "0\r\nContent-Length: 5\r\n\r\n"), 400);
}

/// The library takes a chunk off its limit each time it looks at a line whose quotes go on beyond it.
TEST_F(RequestParserTest, AChunkCountsOnceHoweverItsLineComes) {
  const std::string request =
      "POST / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n64;x=\"\r\n" +
      std::string(200, 'q') + "\"\r\n";
  EXPECT_EQ(status_of(request), 400);
  RequestParser parser(limits);
  int status = 0;
  try {
    for (const char byte : request) parser.feed({&byte, 1});
  } catch (const RequestError& refusal) {
    status = refusal.status();
  }
  EXPECT_EQ(status, 400);
}

TEST_F(RequestParserTest, WaitsForContinueOnlyWhenAsked) {
  RequestParser parser(limits);
  parser.feed("POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 3\r\nExpect: 100-Continue\r\n\r\n");
  EXPECT_EQ(parser.stage(), Stage::body);
  EXPECT_TRUE(parser.wants_continue());
}

}  // namespace
}  // namespace ream::net
