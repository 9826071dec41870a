#include "store/session_index.hpp"

#include "support/test_databases.hpp"

namespace ream::store {
namespace {

SessionRow row(const std::string& id) {
  SessionRow made;
  made.id = id;
  made.case_id = "demo";
  made.script = "practice";
  made.state = "finished";
  made.created_utc = "2026-01-31T12:00:00Z";
  made.duration_s = 12.345678901234567;
  made.trainee_id = "u1";
  made.trainee = "J\xc3\xb6rg 'Bo' %_\\";
  made.study = "pilot";
  made.participant = "P-07";
  made.record = "{\"words\":\"\xe2\x82\xac\"}";
  made.stamp = INT64_MAX - 1;
  made.lasting = false;
  return made;
}

template <typename Store>
class SessionIndexTest : public test::TestDatabase<Store> {};
TYPED_TEST_SUITE(SessionIndexTest, test::BothStores, test::StoreNames);

TYPED_TEST(SessionIndexTest, GivesBackEveryColumn) {
  SessionIndex index(this->database());
  index.put({row("a"), row("b")});
  EXPECT_EQ(index.get("b"), row("b"));
  EXPECT_EQ(index.get("c"), std::nullopt);
}

TYPED_TEST(SessionIndexTest, ReplacesAndRemoves) {
  SessionIndex index(this->database());
  index.put({row("a"), row("b")});
  SessionRow changed = row("a");
  changed.state = "running";
  changed.record = "other";
  changed.stamp = -5;
  index.put({changed});
  EXPECT_EQ(index.get("a"), changed);
  index.remove({"b", "unknown"});
  EXPECT_EQ(index.stamps(), (std::map<std::string, int64_t>{{"a", -5}}));
}

}  // namespace
}  // namespace ream::store
