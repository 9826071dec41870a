#include "api/request_body.hpp"

#include <gtest/gtest.h>

namespace ream::api {
namespace {

net::Request request_with(const std::string& body, const std::string& type = "application/json") {
  net::Request request;
  request.body = body;
  request.headers["content-type"] = type;
  return request;
}

/// Reads the body as a session would be asked for; status and pointers of what was wrong.
std::pair<int, std::vector<std::string>> read(const std::string& body,
                                              const std::string& type = "application/json") {
  try {
    RequestBody reader(request_with(body, type));
    reader.name("case");
    reader.number_or_none("force_scale", 0.0, 1000.0);
    reader.finish();
  } catch (const net::RequestError& error) {
    std::vector<std::string> pointers;
    for (const auto& field : error.errors()) pointers.push_back(field.pointer);
    return {error.status(), pointers};
  }
  return {0, {}};
}

using Pointers = std::vector<std::string>;

TEST(RequestBody, TakesWhatIsWellFormed) {
  EXPECT_EQ(read(R"({"case": "demo"})").first, 0);
  EXPECT_EQ(read(R"({"case": "a-1", "force_scale": 26})", "application/json; charset=utf-8").first, 0);
}

TEST(RequestBody, RefusesWhatIsNoJsonObject) {
  EXPECT_EQ(read("", "text/plain").first, 415);
  EXPECT_EQ(read(R"({"case": "demo"})", "").first, 415);
  for (const char* body :
       {"", "{", R"({"case": "demo"} x)", R"({"force_scale": 1e999})", "\xff", "{'case': 1}"})
    EXPECT_EQ(read(body).first, 400) << body;
  for (const char* body : {"[]", "3", "null", R"("demo")"}) EXPECT_EQ(read(body).first, 422) << body;
}

TEST(RequestBody, NamesEveryFaultAtOnce) {
  EXPECT_EQ(read("{}").second, Pointers{"#/case"});
  EXPECT_EQ(read(R"({"case": 3, "force_scale": "much", "speed/rpm": 1, "x~y": 2})").second,
            (Pointers{"#/case", "#/force_scale", "#/speed~1rpm", "#/x~0y"}));
  EXPECT_EQ(read(R"({"case": "demo", "force_scale": null})").second, Pointers{"#/force_scale"});
}

TEST(RequestBody, NamesAreNoPathsAndNumbersInRange) {
  for (const char* name : {"", "../demo", "/etc", "Demo", "a b", "a.b", "demo\\u0000"})
    EXPECT_EQ(read(std::string(R"({"case": ")") + name + "\"}").second, Pointers{"#/case"}) << name;
  for (const char* number : {"0", "-1", "1000.5"})
    EXPECT_EQ(read(std::string(R"({"case": "demo", "force_scale": )") + number + "}").second,
              Pointers{"#/force_scale"})
        << number;
  EXPECT_EQ(read(R"({"case": "demo", "force_scale": 1000})").first, 0);
}

TEST(RequestBody, DetailSaysItInWords) {
  RequestBody reader(request_with(R"({"scrpt": 1})"));
  reader.name("case");
  try {
    reader.finish();
    FAIL();
  } catch (const net::RequestError& error) {
    EXPECT_STREQ(error.what(),
                 "the request body cannot be used: 'case' is missing; 'scrpt' is not a known key");
  }
}

}  // namespace
}  // namespace ream::api
