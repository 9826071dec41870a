#include "store/audit_table.hpp"

#include "store/sql.hpp"
#include "support/test_databases.hpp"

namespace ream::store {
namespace {

AuditRow row(const std::string& action) {
  return {0,    "2026-01-31T12:00:00Z", "u1", "anna", "operator", "c1", "127.0.0.1", action,
          "s1", "J\xc3\xb6rg 'Bo' %_\\"};
}

/// A chain that can be read.
void link_plainly(const std::string& previous, AuditRow& made) {
  made.nonce = "n";
  made.seal = made.name;
  made.chain = previous + "/" + std::to_string(made.number) + made.action;
}

template <typename Store>
class AuditTableTest : public test::TestDatabase<Store> {};
TYPED_TEST_SUITE(AuditTableTest, test::BothStores, test::StoreNames);

TYPED_TEST(AuditTableTest, IsReadInPagesNewestFirst) {
  AuditTable audit(this->database(), link_plainly);
  EXPECT_TRUE(audit.list(INT64_MAX, 10).empty());
  for (const char* action : {"one", "two", "three"}) audit.add(row(action));
  const auto first = audit.list(INT64_MAX, 2);
  ASSERT_EQ(first.size(), 2u);
  EXPECT_EQ(first[0].action, "three");
  EXPECT_EQ(first[1].action, "two");
  EXPECT_GT(first[0].number, first[1].number);
  const auto rest = audit.list(first[1].number, 2);
  ASSERT_EQ(rest.size(), 1u);
  AuditRow expected = row("one");
  expected.number = 1;
  link_plainly("", expected);
  EXPECT_EQ(rest[0], expected);
  EXPECT_EQ(audit.list_from(1, 10).front(), first[1]);
  EXPECT_EQ(audit.head()->chain, "/1one/2two/3three");
}

TYPED_TEST(AuditTableTest, WhatIsOnlyTriedLeavesNothing) {
  AuditTable audit(this->database(), link_plainly);
  audit.try_to_add(row("tried"));
  EXPECT_FALSE(audit.head());
  audit.add(row("one"));
  audit.try_to_add(row("tried"));
  audit.add(row("two"));
  EXPECT_EQ(audit.head()->chain, "/1one/2two");
  this->database().run([](Sql& sql) { sql << "DROP TABLE audit_head"; });
  EXPECT_THROW(audit.try_to_add(row("tried")), Error);
  EXPECT_THROW(audit.add(row("three")), Error);
  EXPECT_EQ(audit.list(INT64_MAX, 10).size(), 2u) << "nothing by halves";
}

TYPED_TEST(AuditTableTest, RowsOfATimeBeforeTheChainAreChained) {
  this->database().run([](Sql& sql) {
    for (const char* action : {"old", "older"})
      sql << "INSERT INTO audit (at_utc, user_id, name, role, credential, address, action, object, detail) "
             "VALUES ('', '', '', '', '', '', '" +
                 std::string(action) + "', '', '')";
  });
  AuditTable audit(this->database(), link_plainly);
  audit.add(row("new"));
  EXPECT_EQ(audit.head()->chain, "/1old/2older/3new");
  EXPECT_EQ(audit.list_from(0, 1).front().chain, "/1old");
}

TYPED_TEST(AuditTableTest, RowsOfOnePersonLoseTheirTexts) {
  AuditTable audit(this->database(), link_plainly);
  audit.add(row("by"));
  AuditRow about = row("about");
  about.user_id = "u2";
  about.name = "ben";
  about.object = "u1";
  audit.add(about);
  AuditRow named = about;
  named.object = "s1";
  named.detail = "anna as trainee";
  audit.add(named);
  AuditRow other = named;
  other.detail = "carl";
  audit.add(other);
  EXPECT_EQ(audit.make_anonymous("u1", {"anna", ""}), 3);
  EXPECT_EQ(audit.make_anonymous("u1", {"anna"}), 0) << "once";
  const auto rows = audit.list_from(0, 10);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(rows[i].name + rows[i].address + rows[i].detail + rows[i].nonce, "") << i;
    EXPECT_NE(rows[i].chain, "") << i;
  }
  EXPECT_EQ(rows[3].detail, "carl");
}

}  // namespace
}  // namespace ream::store
