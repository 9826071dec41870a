#include "access/role.hpp"

#include <gtest/gtest.h>

namespace ream::access {
namespace {

constexpr Role all[] = {Role::viewer, Role::trainee, Role::instructor, Role::operator_};

TEST(Role, WordsGoThereAndBack) {
  for (const Role role : all) EXPECT_EQ(role_from(to_text(role)), role);
  for (const char* word : {"", "Operator", "operator_", "root"}) EXPECT_FALSE(role_from(word)) << word;
}

TEST(Role, ATokenIsNeverWiderThanItsOwner) {
  for (const Role of : all)
    for (const Role limit : all)
      EXPECT_FALSE(limit > of && may_be_limited(of, limit)) << to_text(of) << to_text(limit);
  for (const Role of : all) EXPECT_TRUE(may_be_limited(of, of)) << to_text(of);
  EXPECT_TRUE(may_be_limited(Role::instructor, Role::viewer));
  EXPECT_FALSE(may_be_limited(Role::trainee, Role::viewer)) << "viewers see the sessions of all";
}

}  // namespace
}  // namespace ream::access
