#include "access/audit_log.hpp"

#include "store/sql.hpp"
#include "support/hand_clock.hpp"
#include "support/test_databases.hpp"

namespace ream::access {
namespace {

using Lines = std::vector<std::string>;

template <typename Store>
class AuditLogTest : public test::TestDatabase<Store> {
 protected:
  const Actor anna{"u1", "anna", "operator", "c1", "10.0.0.1"};
  void fill(int rows) {
    for (int i = 1; i <= rows; ++i) audit.note(anna, "session.delete", "s" + std::to_string(i), "old");
  }
  void tamper(const std::string& statement) {
    this->database().run([&](store::Sql& sql) { sql << statement; });
  }
  /// What is wrong now, by the row's name.
  Lines faulty() {
    Lines rows;
    for (const std::string& fault : audit.check().faults) rows.push_back(fault.substr(0, fault.find(':')));
    return rows;
  }
  test::HandClock clock;
  AuditLog audit{this->database(), clock.function()};
};
TYPED_TEST_SUITE(AuditLogTest, test::BothStores, test::StoreNames);

TYPED_TEST(AuditLogTest, AWholeLogIsFoundWhole) {
  EXPECT_TRUE(this->audit.check().faults.empty()) << "an empty one, too";
  this->fill(5);
  const AuditCheck check = this->audit.check();
  EXPECT_EQ(check.faults, Lines{});
  EXPECT_EQ(check.rows, 5);
  EXPECT_EQ(check.head.number, 5);
  this->fill(2);
  EXPECT_EQ(this->audit.check(check.head).faults, Lines{}) << "what was written down is still in it";
}

TYPED_TEST(AuditLogTest, EachChangeIsFoundAtItsRow) {
  for (const char* change : {"name = 'ben'", "address = ''", "detail = 'x'", "action = 'login'",
                             "object = 's9'", "at_utc = '2020-01-01T00:00:00Z'", "user_id = 'u2'",
                             "role = 'trainee'", "credential = 'c2'", "seal = 'x'", "nonce = 'x'"}) {
    SCOPED_TRACE(change);
    this->tamper("DELETE FROM audit");
    this->tamper("DELETE FROM audit_head");
    this->fill(4);
    this->tamper(std::string("UPDATE audit SET ") + change + " WHERE number = 2");
    const Lines rows = this->faulty();
    ASSERT_FALSE(rows.empty());
    for (const std::string& row : rows) EXPECT_EQ(row, "row 2");
  }
}

TYPED_TEST(AuditLogTest, RowsThatAreMissingPutInOrExchangedAreFound) {
  this->fill(6);
  this->tamper("DELETE FROM audit WHERE number = 3");
  EXPECT_EQ(this->faulty(), Lines{"row 4"});
  this->tamper(
      "INSERT INTO audit (number, at_utc, user_id, name, role, credential, address, action, object, detail, "
      "nonce, seal, chain) SELECT 3, at_utc, user_id, name, role, credential, address, action, object, "
      "detail, nonce, seal, chain FROM audit WHERE number = 2");
  EXPECT_FALSE(this->faulty().empty());
  this->tamper("DELETE FROM audit WHERE number = 6");
  EXPECT_EQ(this->faulty().back(), "row 5") << "the end was cut";
  this->tamper("DELETE FROM audit_head");
  EXPECT_EQ(this->faulty().back(), "row 5");
  this->tamper("DELETE FROM audit");
  EXPECT_EQ(this->audit.check({6, "as it was"}).faults.size(), 1u) << "all of it is gone; somebody remembers";
}

TYPED_TEST(AuditLogTest, AChainThatWasMadeAnewIsNotTheOneWrittenDown) {
  this->fill(3);
  const store::AuditHead before = this->audit.check().head;
  this->tamper("DELETE FROM audit WHERE number > 1");
  this->tamper("UPDATE audit_head SET number = 1, chain = (SELECT chain FROM audit WHERE number = 1)");
  this->fill(3);
  EXPECT_EQ(this->faulty(), Lines{});
  EXPECT_EQ(this->audit.check(before).faults.size(), 1u);
}

TYPED_TEST(AuditLogTest, ForgettingSomebodyKeepsTheChainWhole) {
  this->fill(2);
  this->audit.note({"u2", "ben", "operator", "c2", "10.0.0.2"}, "user.add", "u1", "anna as operator");
  EXPECT_EQ(this->audit.forget("u1", {"anna"}), 3);
  EXPECT_EQ(this->faulty(), Lines{"row 3"}) << "nobody says yet that somebody was forgotten";
  this->audit.note({}, "user.forget", "u1", "");
  const AuditCheck check = this->audit.check();
  EXPECT_EQ(check.faults, Lines{});
  EXPECT_EQ(check.anonymous, 3);
  this->tamper("UPDATE audit SET detail = 'nothing happened' WHERE number = 1");
  EXPECT_EQ(this->faulty(), Lines{"row 1"});
}

TYPED_TEST(AuditLogTest, ReadingsAreKeptOnceForEachLoginAndObject) {
  Actor other_login = this->anna, nobody{"", "", "operator", "", "10.0.0.1"}, elsewhere = nobody;
  other_login.credential = "c2";
  elsewhere.address = "10.0.0.2";
  for (int i = 0; i < 3; ++i)
    for (const Actor& actor : {this->anna, other_login, nobody, elsewhere})
      for (const char* object : {"case1", "case2"}) this->audit.note_reading(actor, "case.ct", object);
  EXPECT_EQ(this->audit.check().rows, 8);
}

TYPED_TEST(AuditLogTest, WhatCannotBeKeptIsRefused) {
  this->fill(1);
  this->tamper("DROP TABLE audit");
  EXPECT_THROW(this->audit.require_writable(), Error);
  EXPECT_THROW(this->audit.note(this->anna, "session.delete", "s1", ""), Error);
  EXPECT_THROW(this->audit.note_reading(this->anna, "case.ct", "c1"), Error);
  EXPECT_THROW(this->audit.note_reading(this->anna, "case.ct", "c1"), Error) << "and is tried again";
}

}  // namespace
}  // namespace ream::access
