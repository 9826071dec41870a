#include "net/message.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "net/problem.hpp"

namespace ream::net {
namespace {

Request target(std::string_view text) {
  Request request;
  set_target(request, text);
  return request;
}

TEST(Target, SplitsPathAndQueryAndDecodesBoth) {
  const Request request = target("/cases/left%20one?a=1+2&b=%C3%A9&flag&a=3");
  EXPECT_EQ(request.path, "/cases/left one");
  EXPECT_EQ(request.query.at("a"), "3");
  EXPECT_EQ(request.query.at("b"), "\xC3\xA9");
  EXPECT_EQ(request.query.at("flag"), "");
}

TEST(Target, RefusesWhatWouldBeAmbiguous) {
  for (const char* text : {"", "cases", "http://localhost/x", "*", "/a%2fb", "/a%2Fb", "/a%5Cb", "/a\\b",
                           "/a%00b", "/a%0ab", "/a\x01", "/a%7F", "/%", "/%4", "/%zz", "/a?x=%q1"})
    EXPECT_THROW(target(text), RequestError) << text;
  EXPECT_THROW(target(std::string_view("/a\0b", 4)), RequestError);
}

TEST(Problem, CarriesKindAsStatusAndPlaces) {
  EXPECT_EQ(problem_of(Error(ErrorKind::not_found, "x")).status, 404);
  EXPECT_EQ(problem_of(Error(ErrorKind::conflict, "x")).status, 409);
  EXPECT_EQ(problem_of(Error(ErrorKind::unavailable, "x")).status, 503);
  EXPECT_EQ(problem_of(Error(ErrorKind::usage, "x")).status, 400);
  EXPECT_EQ(problem_of(Error(ErrorKind::invalid_input, "x")).status, 422);
  EXPECT_EQ(problem_of(Error(ErrorKind::io, "x")).status, 500);
  const Response response = problem_of(RequestError(400, "bad", {{"#/a", "must be a number"}}));
  EXPECT_EQ(response.content_type, "application/problem+json");
  const auto body =
      nlohmann::json::parse(reinterpret_cast<const char*>(response.body->data()),
                            reinterpret_cast<const char*>(response.body->data()) + response.body->size());
  EXPECT_EQ(body, (nlohmann::json{{"type", "about:blank"},
                                  {"title", "Bad Request"},
                                  {"status", 400},
                                  {"detail", "bad"},
                                  {"errors", {{{"pointer", "#/a"}, {"detail", "must be a number"}}}}}));
  const Response later = problem_of(RequestError(429, "later", {}, {{"Retry-After", "7"}}));
  EXPECT_EQ(later.status, 429);
  EXPECT_EQ(later.header("Retry-After"), "7");
}

TEST(Problem, InnerWordsOfAnUnknownFailureStayInTheLog) {
  const Response response = problem_of(std::runtime_error("secret detail"));
  EXPECT_EQ(response.status, 500);
  const std::string text(reinterpret_cast<const char*>(response.body->data()), response.body->size());
  EXPECT_EQ(text.find("secret"), std::string::npos);
}

TEST(JsonResponse, BrokenUtf8DoesNotFailTheReply) {
  EXPECT_NO_THROW(json_response(200, {{"name", "\xff\xfe"}}));
}

}  // namespace
}  // namespace ream::net
