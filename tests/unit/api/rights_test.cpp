#include "api/rights.hpp"

#include <gtest/gtest.h>

#include <set>

namespace ream::api {
namespace {

using access::instructors;
using access::operators;
using access::role_bit;
using access::trainees;
using access::viewers;

TEST(Rights, HaveOneRowARoute) {
  std::set<std::string> seen;
  for (const Right& right : rights())
    EXPECT_TRUE(seen.insert(right.method + " " + right.pattern).second) << right.method << right.pattern;
}

TEST(Rights, EveryRowBehindADoorNamesSomebody) {
  for (const Right& right : rights())
    EXPECT_EQ(right.who == 0, right.route_access == RouteAccess::anybody)
        << right.method << ' ' << right.pattern;
}

TEST(Rights, OperatorsMayUseEveryRoute) {
  for (const Right& right : rights())
    EXPECT_TRUE(right.route_access == RouteAccess::anybody || right.who & operators) << right.pattern;
}

TEST(Rights, AWiderRoleMayAllThatANarrowerOneMay) {
  for (const Right& right : rights()) {
    EXPECT_FALSE(right.who & viewers && !(right.who & trainees)) << right.pattern;
    EXPECT_FALSE(right.who & trainees && !(right.who & instructors)) << right.pattern;
  }
}

TEST(Rights, ViewersChangeNothingButReplays) {
  for (const Right& right : rights())
    EXPECT_TRUE(!(right.who & viewers) || right.method == "GET" || right.pattern.ends_with("/replay") ||
                right.pattern.ends_with("/playback"))
        << right.pattern;
}

TEST(Rights, AreFoundByMethodAndPattern) {
  ASSERT_NE(right_of("GET", "/api/v1/audit"), nullptr);
  EXPECT_EQ(right_of("GET", "/api/v1/audit")->who, operators);
  EXPECT_EQ(right_of("HEAD", "/api/v1/audit"), right_of("GET", "/api/v1/audit"));
  EXPECT_EQ(right_of("POST", "/api/v1/audit"), nullptr);
  EXPECT_EQ(right_of("GET", "/api/v1/nothing"), nullptr);
}

TEST(Rights, KnowTheWordsOfTheRolesOnly) {
  EXPECT_EQ(role_bit("operator"), operators);
  EXPECT_EQ(role_bit("instructor"), instructors);
  EXPECT_EQ(role_bit("trainee"), trainees);
  EXPECT_EQ(role_bit("viewer"), viewers);
  for (const char* word : {"", "Operator", "root", "operator "}) EXPECT_EQ(role_bit(word), 0u) << word;
}

}  // namespace
}  // namespace ream::api
