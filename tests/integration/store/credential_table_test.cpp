#include "store/credential_table.hpp"

#include <algorithm>

#include "support/test_databases.hpp"

namespace ream::store {
namespace {

using Ids = std::vector<std::string>;

CredentialRow credential(const std::string& id, const std::string& kind, const std::string& user_id,
                         const std::string& parent_id = {}) {
  return {id,
          kind,
          "hash of " + id,
          user_id,
          "trainee",
          "J\xc3\xb6rg's robot",
          "s1",
          parent_id,
          "2026-01-31T12:00:00Z",
          "2026-02-28T12:00:00Z",
          "2026-02-01T00:00:00Z"};
}

Ids sorted(Ids ids) {
  std::sort(ids.begin(), ids.end());
  return ids;
}

template <typename Store>
class CredentialTableTest : public test::TestDatabase<Store> {
 protected:
  CredentialTableTest() {
    users.add({"u1", "anna", "Anna", "operator", "2026-01-31T12:00:00Z", "hash", true});
    users.add({"u2", "ben", "Ben", "trainee", "2026-01-31T12:00:00Z", "hash", false});
  }
  UserTable users{this->database(), "operator"};
  CredentialTable credentials{this->database()};
};
TYPED_TEST_SUITE(CredentialTableTest, test::BothStores, test::StoreNames);

TYPED_TEST(CredentialTableTest, IsFoundWithItsUser) {
  this->credentials.add(credential("a", "token", "u1"));
  this->credentials.add(credential("b", "token", "u2"));
  this->credentials.add(credential("c", "link", ""));
  const auto a = this->credentials.find("a");
  ASSERT_TRUE(a && a->user);
  EXPECT_EQ(a->credential, credential("a", "token", "u1"));
  EXPECT_EQ(a->user->name, "anna");
  EXPECT_EQ(a->user->role, "operator");
  EXPECT_TRUE(a->user->enabled);
  EXPECT_EQ(a->user->password_hash, "") << "nobody needs it here";
  const auto b = this->credentials.find("b");
  ASSERT_TRUE(b && b->user);
  EXPECT_FALSE(b->user->enabled);
  const auto c = this->credentials.find("c");
  ASSERT_TRUE(c);
  EXPECT_FALSE(c->user);
  EXPECT_FALSE(this->credentials.find("hash of a"));
}

TYPED_TEST(CredentialTableTest, ListsByKindAndUserNewestFirst) {
  CredentialRow newer = credential("b", "token", "u1");
  newer.created_utc = "2026-02-01T12:00:00Z";
  this->credentials.add(credential("a", "token", "u1"));
  this->credentials.add(newer);
  this->credentials.add(credential("c", "token", "u2"));
  this->credentials.add(credential("d", "cookie", "u1"));
  EXPECT_EQ(this->credentials.list("token", "u1"),
            (std::vector<CredentialRow>{newer, credential("a", "token", "u1")}));
  EXPECT_EQ(this->credentials.list("token", "").size(), 3u);
  EXPECT_EQ(this->credentials.list("link", "").size(), 0u);
}

TYPED_TEST(CredentialTableTest, RemembersItsUse) {
  this->credentials.add(credential("a", "token", "u1"));
  this->credentials.note_use("a", "2026-02-02T00:00:00Z");
  this->credentials.note_use("unknown", "2026-02-02T00:00:00Z");
  EXPECT_EQ(this->credentials.find("a")->credential.last_used_utc, "2026-02-02T00:00:00Z");
}

TYPED_TEST(CredentialTableTest, GoesWithAllThatWasMadeWithIt) {
  this->credentials.add(credential("link", "link", "u1"));
  this->credentials.add(credential("cookie", "cookie", "", "link"));
  this->credentials.add(credential("other", "cookie", "u1"));
  EXPECT_EQ(sorted(this->credentials.remove("link")), (Ids{"cookie", "link"}));
  EXPECT_FALSE(this->credentials.find("cookie"));
  EXPECT_TRUE(this->credentials.find("other"));
  EXPECT_EQ(this->credentials.remove("link"), Ids{});
}

TYPED_TEST(CredentialTableTest, GoesWithItsUser) {
  this->credentials.add(credential("a", "token", "u1"));
  this->credentials.add(credential("b", "cookie", "u1"));
  this->credentials.add(credential("c", "cookie", "u1"));
  this->credentials.add(credential("d", "cookie", "u2"));
  this->credentials.add(credential("e", "link", "u1"));
  this->credentials.add(credential("f", "cookie", "", "e"));
  EXPECT_EQ(this->credentials.remove_of_user("u1", "cookie", "c"), Ids{"b"});
  EXPECT_EQ(sorted(this->credentials.remove_of_user("u1", "", "")), (Ids{"a", "c", "e", "f"}));
  EXPECT_TRUE(this->credentials.find("d"));
}

TYPED_TEST(CredentialTableTest, IsRemovedSomeTimeAfterItsEnd) {
  this->credentials.add(credential("a", "token", "u1"));
  this->credentials.remove_expired("2026-02-28T12:00:00Z");
  EXPECT_TRUE(this->credentials.find("a"));
  this->credentials.remove_expired("2026-02-28T12:00:01Z");
  EXPECT_FALSE(this->credentials.find("a"));
}

}  // namespace
}  // namespace ream::store
