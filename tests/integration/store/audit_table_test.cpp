#include "store/audit_table.hpp"

#include "support/test_databases.hpp"

namespace ream::store {
namespace {

AuditRow row(const std::string& action) {
  return {0,    "2026-01-31T12:00:00Z", "u1", "anna", "operator", "c1", "127.0.0.1", action,
          "s1", "J\xc3\xb6rg 'Bo' %_\\"};
}

template <typename Store>
class AuditTableTest : public test::TestDatabase<Store> {};
TYPED_TEST_SUITE(AuditTableTest, test::BothStores, test::StoreNames);

TYPED_TEST(AuditTableTest, IsReadInPagesNewestFirst) {
  AuditTable audit(this->database());
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
  expected.number = rest[0].number;
  EXPECT_EQ(rest[0], expected);
}

}  // namespace
}  // namespace ream::store
