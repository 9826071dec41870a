#include "store/user_table.hpp"

#include "support/expect_error.hpp"
#include "support/test_databases.hpp"

namespace ream::store {
namespace {

UserRow user(const std::string& name, const std::string& role) {
  return {"id-of-" + name, name, "J\xc3\xb6rg 'Bo' %_\\", role, "2026-01-31T12:00:00Z", "$argon2id$x", true};
}

template <typename Store>
class UserTableTest : public test::TestDatabase<Store> {
 protected:
  UserTable users{this->database(), "operator"};
};
TYPED_TEST_SUITE(UserTableTest, test::BothStores, test::StoreNames);

TYPED_TEST(UserTableTest, GivesBackEveryColumn) {
  EXPECT_FALSE(this->users.any());
  UserRow second = user("ben", "trainee");
  second.enabled = false;
  this->users.add(user("anna", "operator"));
  this->users.add(second);
  EXPECT_TRUE(this->users.any());
  EXPECT_EQ(this->users.find("id-of-ben"), second);
  EXPECT_EQ(this->users.find_by_name("anna"), user("anna", "operator"));
  EXPECT_EQ(this->users.find("anna"), std::nullopt);
  EXPECT_EQ(this->users.find_by_name("Anna"), std::nullopt);
  EXPECT_EQ(this->users.list(), (std::vector<UserRow>{user("anna", "operator"), second}));
}

TYPED_TEST(UserTableTest, NamesAreTakenOnce) {
  this->users.add(user("anna", "operator"));
  UserRow same = user("anna", "operator");
  same.id = "another";
  test::expect_error(ErrorKind::conflict, "'anna'", [&] { this->users.add(same); });
  EXPECT_EQ(this->users.list().size(), 1u);
}

TYPED_TEST(UserTableTest, TheFirstUserHasTheKeptRole) {
  test::expect_error(ErrorKind::conflict, "must be operator", [&] { this->users.add(user("t", "trainee")); });
  UserRow disabled = user("d", "operator");
  disabled.enabled = false;
  test::expect_error(ErrorKind::conflict, "must be operator", [&] { this->users.add(disabled); });
  EXPECT_FALSE(this->users.any());
}

TYPED_TEST(UserTableTest, ChangesInOneGo) {
  this->users.add(user("anna", "operator"));
  const UserRow changed = this->users.change("id-of-anna", [](UserRow& row) {
    row.display_name = "Anna";
    row.password_hash = "$argon2id$y";
  });
  EXPECT_EQ(changed.display_name, "Anna");
  EXPECT_EQ(this->users.find("id-of-anna"), changed);
  test::expect_error(ErrorKind::not_found, "no user 'x'", [&] { this->users.change("x", [](UserRow&) {}); });
  test::expect_error(ErrorKind::not_found, "no user 'x'", [&] { this->users.remove("x"); });
}

TYPED_TEST(UserTableTest, TheLastOfTheKeptRoleStays) {
  this->users.add(user("anna", "operator"));
  this->users.add(user("ben", "instructor"));
  const auto refused = [&](auto&& action) {
    test::expect_error(ErrorKind::conflict, "'anna' is the last operator", action);
  };
  refused([&] { this->users.remove("id-of-anna"); });
  refused([&] { this->users.change("id-of-anna", [](UserRow& row) { row.role = "instructor"; }); });
  refused([&] { this->users.change("id-of-anna", [](UserRow& row) { row.enabled = false; }); });
  EXPECT_EQ(this->users.find("id-of-anna"), user("anna", "operator")) << "nothing was changed";
  this->users.change("id-of-ben", [](UserRow& row) { row.role = "operator"; });
  this->users.remove("id-of-anna");
  EXPECT_EQ(this->users.find("id-of-anna"), std::nullopt);
}

}  // namespace
}  // namespace ream::store
