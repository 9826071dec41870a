#include "api/visibility.hpp"

#include <gtest/gtest.h>

#include "support/expect_error.hpp"

namespace ream::api {
namespace {

net::Caller caller(const std::string& role, const std::string& user_id = {},
                   const std::string& only_session = {}) {
  return {user_id, "somebody", role, only_session, "credential"};
}

session::SessionRequest session(const std::string& id, const std::string& trainee_id) {
  session::SessionRequest request;
  request.id = id;
  request.trainee_id = trainee_id;
  return request;
}

TEST(Visibility, StaffSeesAll) {
  for (const char* role : {"operator", "instructor"}) {
    EXPECT_TRUE(may_see(caller(role, "u1"), session("s1", "u2"))) << role;
    EXPECT_TRUE(may_see(caller(role), session("s1", ""))) << role;
  }
}

TEST(Visibility, TraineesSeeTheirOwn) {
  EXPECT_TRUE(may_see(caller("trainee", "u1"), session("s1", "u1")));
  EXPECT_FALSE(may_see(caller("trainee", "u1"), session("s1", "u2")));
  EXPECT_FALSE(may_see(caller("trainee", "u1"), session("s1", "")));
  EXPECT_FALSE(may_see(caller("trainee", ""), session("s1", "")));
}

TEST(Visibility, ALinkShowsItsSessionOrAll) {
  EXPECT_TRUE(may_see(caller("viewer", "", "s1"), session("s1", "u1")));
  EXPECT_FALSE(may_see(caller("viewer", "", "s1"), session("s2", "u1")));
  EXPECT_TRUE(may_see(caller("viewer"), session("s2", "u1")));
}

TEST(Visibility, WhoIsNotKnownSeesNothing) {
  EXPECT_FALSE(may_see(caller(""), session("s1", "")));
  EXPECT_FALSE(may_see(caller("root", "u1"), session("s1", "u1")));
}

TEST(Visibility, WhatIsNotSeenDoesNotExist) {
  EXPECT_FALSE(may_see(caller("trainee", "u1"), session("s1", "u2")));
  test::expect_error(ErrorKind::not_found, "no session 's1'", [] { refuse_unseen("s1"); });
}

}  // namespace
}  // namespace ream::api
