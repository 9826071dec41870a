#include "net/message.hpp"

#include <gtest/gtest.h>

namespace ream::net {
namespace {

Response answer(int status, std::vector<std::pair<std::string, std::string>> headers) {
  Response response = bytes_response(status, "text/plain", share("hello"));
  response.headers = std::move(headers);
  return response;
}

TEST(ResponseHead, HasStatusHeadersTypeAndLength) {
  EXPECT_EQ(response_head(answer(200, {{"ETag", "\"1\""}}), {{"X-Always", "yes"}}, true),
            "HTTP/1.1 200 OK\r\nETag: \"1\"\r\nX-Always: yes\r\nContent-Type: text/plain\r\nContent-Length: "
            "5\r\n\r\n");
}

TEST(ResponseHead, HandlerMayReplaceWhatIsSetOnAll) {
  const std::string head = response_head(answer(200, {{"X-Always", "no"}}), {{"X-Always", "yes"}}, false);
  EXPECT_EQ(head.find("yes"), std::string::npos);
  EXPECT_NE(head.find("X-Always: no\r\n"), std::string::npos);
  EXPECT_NE(head.find("Connection: close\r\n"), std::string::npos);
}

TEST(ResponseHead, NotModifiedHasNoLength) {
  EXPECT_EQ(response_head(Response{304, {}, nullptr, {}}, {}, true), "HTTP/1.1 304 Not Modified\r\n\r\n");
}

TEST(ResponseHead, NothingBreaksOutOfItsLine) {
  for (const char* value : {"a\r\nSet-Cookie: x=1", "a\nb", "a\rb", "\x7f"}) {
    const std::string head = response_head(answer(200, {{"Location", value}}), {}, true);
    EXPECT_EQ(head.find("Location"), std::string::npos) << head;
    EXPECT_EQ(head.find("Set-Cookie"), std::string::npos) << head;
  }
  EXPECT_EQ(response_head(answer(200, {{"A: b\r\nC", "d"}}), {}, true).find("C: d"), std::string::npos);
}

}  // namespace
}  // namespace ream::net
