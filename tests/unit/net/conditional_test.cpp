#include "net/conditional.hpp"

#include <gtest/gtest.h>

#include "net/problem.hpp"

namespace ream::net {
namespace {

Request get(const std::string& known_tags, const std::string& method = "GET") {
  Request request;
  request.method = method;
  if (!known_tags.empty()) request.headers["if-none-match"] = known_tags;
  return request;
}

TEST(Conditional, TagsAreFoundInLists) {
  for (const char* list : {"\"a\"", "W/\"a\"", "\"b\", \"a\"", "\"b\" , W/\"a\",\"c\"", "*", ",, \"a\""})
    EXPECT_TRUE(names_tag(list, "\"a\"")) << list;
  for (const char* list : {"", "a", "\"ab\"", "\"b\",\"c\"", "\"a", "b\"a\"", "\"b\" x \"a\"", "W/", "W/a"})
    EXPECT_FALSE(names_tag(list, "\"a\"")) << list;
  EXPECT_TRUE(names_tag("\"a\"", "W/\"a\""));
  EXPECT_FALSE(names_tag_strongly("W/\"a\"", "\"a\""));
  EXPECT_FALSE(names_tag_strongly("W/\"a\"", "W/\"a\""));
  EXPECT_TRUE(names_tag_strongly("\"b\", \"a\"", "\"a\""));
}

TEST(Conditional, SameBodyIs304AndAnotherIsNot) {
  const Response first = conditional(get(""), bytes_response(200, "text/plain", share("one")));
  const std::string tag(first.header("ETag"));
  EXPECT_EQ(first.status, 200);
  EXPECT_EQ(tag.size(), 18u);
  const Response same = conditional(get(tag, "HEAD"), bytes_response(200, "text/plain", share("one")));
  EXPECT_EQ(same.status, 304);
  EXPECT_EQ(same.body, nullptr);
  EXPECT_EQ(same.header("ETag"), tag);
  EXPECT_EQ(conditional(get(tag), bytes_response(200, "text/plain", share("two"))).status, 200);
}

TEST(Conditional, TagOfTheHandlerIsKept) {
  Response response = bytes_response(200, "text/plain", share("one"));
  response.headers.emplace_back("ETag", "W/\"v7\"");
  EXPECT_EQ(conditional(get("\"v7\""), response).status, 304);
  EXPECT_EQ(conditional(get("\"v8\""), response).header("ETag"), "W/\"v7\"");
}

TEST(Conditional, OnlyReadsThatWentWellAreTouched) {
  EXPECT_TRUE(conditional(get("*", "POST"), bytes_response(200, "", share("x"))).header("ETag").empty());
  EXPECT_EQ(conditional(get("*"), problem(404, "gone")).status, 404);
  EXPECT_EQ(conditional(get("*"), Response{204, {}, nullptr, {}}).status, 204);
}

TEST(Conditional, ChangeOfSomethingElseThanWasReadIs412) {
  Request request;
  EXPECT_FALSE(require_match(request, "\"a\""));
  request.headers["if-match"] = "\"a\"";
  EXPECT_TRUE(require_match(request, "\"a\""));
  try {
    require_match(request, "\"b\"");
    FAIL() << "passed";
  } catch (const RequestError& error) {
    EXPECT_EQ(error.status(), 412);
  }
}

}  // namespace
}  // namespace ream::net
