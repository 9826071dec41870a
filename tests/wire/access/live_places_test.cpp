// Places for live sessions: nobody can take them all.
#include "wire/contract/access_fixture.hpp"

namespace ream::test {
namespace {

class LivePlacesTest : public AccessTest {
 protected:
  HttpReply make_session(const Sent& as) {
    return request("POST", "/api/v1/sessions", as, R"({"case": "planned", "script": "demo"})");
  }
};

TEST_F(LivePlacesTest, OneTraineeLeavesPlacesToOthers) {
  start();
  add_user("olga", access::Role::operator_);
  const Sent tom = token_of(add_user("tom", access::Role::trainee)),
             tess = token_of(add_user("tess", access::Role::trainee)),
             ina = token_of(add_user("ina", access::Role::instructor));
  const HttpReply first = make_session(tom);
  ASSERT_EQ(first.status, 201) << first.body;
  EXPECT_EQ(make_session(tom).status, 201);
  const HttpReply third = make_session(tom);
  expect_as_described("POST", "/api/v1/sessions", 409, third);
  EXPECT_NE(third.body.find("2 of your sessions are live"), std::string::npos) << third.body;
  EXPECT_EQ(make_session(tess).status, 201);
  EXPECT_EQ(make_session(ina).status, 201);
  expect_as_described("POST", "/api/v1/sessions", 503, make_session(ina));

  // A place that is given back can be had again.
  const std::string id = json::parse(first.body).at("id");
  EXPECT_EQ(request("POST", "/api/v1/sessions/" + id + "/stop", tom).status, 200);
  EXPECT_EQ(make_session(tom).status, 201);
}

TEST_F(LivePlacesTest, WithoutUsersTheMachineIsOnePersons) {
  start();
  for (size_t i = 0; i < options.sessions.live; ++i) EXPECT_EQ(make_session({}).status, 201) << i;
  EXPECT_EQ(make_session({}).status, 503);
}

}  // namespace
}  // namespace ream::test
