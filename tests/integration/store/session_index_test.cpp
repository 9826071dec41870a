#include "store/session_index.hpp"

#include <algorithm>
#include <random>

#include "support/expect_error.hpp"
#include "support/seed.hpp"
#include "support/test_databases.hpp"

namespace ream::store {
namespace {

SessionRow session_row(const std::string& id) {
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
  made.title = "first";
  made.points = 200.0 / 3.0;
  made.outcome = "undecided";
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
  index.put({session_row("a"), session_row("b")});
  EXPECT_EQ(index.get("b"), session_row("b"));
  SessionRow unjudged = session_row("d");
  unjudged.points.reset();
  unjudged.outcome.clear();
  index.put({unjudged});
  EXPECT_EQ(index.get("d"), unjudged);
  EXPECT_EQ(index.get("c"), std::nullopt);
}

TYPED_TEST(SessionIndexTest, ReplacesAndRemoves) {
  SessionIndex index(this->database());
  index.put({session_row("a"), session_row("b")});
  SessionRow changed = session_row("a");
  changed.state = "running";
  changed.record = "other";
  changed.stamp = -5;
  index.put({changed});
  EXPECT_EQ(index.get("a"), changed);
  index.remove({"b", "unknown"});
  const auto marks = index.marks();
  ASSERT_EQ(marks.size(), 1u);
  EXPECT_EQ(marks.at("a").stamp, -5);
  EXPECT_FALSE(marks.at("a").lasting);
}

TYPED_TEST(SessionIndexTest, RefusesTextThatNoDatabaseHolds) {
  SessionIndex index(this->database());
  for (const std::string& text :
       {std::string("a\0b", 3), std::string("\xff"), std::string("\xc0\x80"), std::string("\xed\xa0\x80")}) {
    SessionRow bad = session_row("a");
    bad.trainee = text;
    test::expect_error(ErrorKind::invalid_input, "UTF-8", [&] { index.put({session_row("b"), bad}); });
    SessionQuery query;
    query.study = text;
    test::expect_error(ErrorKind::invalid_input, "UTF-8", [&] { index.find(query); });
  }
  EXPECT_TRUE(index.marks().empty());
}

TYPED_TEST(SessionIndexTest, IsMadeAnewAsAWhole) {
  SessionIndex index(this->database());
  index.put({session_row("a"), session_row("b")});
  SessionRow bad = session_row("d");
  bad.title = "\xff";
  test::expect_error(ErrorKind::invalid_input, "UTF-8", [&] { index.replace_all({session_row("c"), bad}); });
  EXPECT_EQ(index.marks().size(), 2u);
  index.replace_all({session_row("c")});
  EXPECT_EQ(index.get("a"), std::nullopt);
  EXPECT_EQ(index.get("c"), session_row("c"));
}

/// Few different values, so that filters let some pass and sorting meets equals.
class RandomSessions {
 public:
  explicit RandomSessions(unsigned seed) : random_(seed) {}

  SessionRow row(int number) {
    SessionRow made;
    made.id = "s" + std::to_string(number * 7919 % 1000);
    made.case_id = one_of({"demo", "left-b2", "right"});
    made.script = one_of({"demo", "practice"});
    made.state = one_of({"finished", "stopped", "fault", "interrupted"});
    made.created_utc = one_of({"2026-01-31T12:00:00Z", "2026-02-01T00:00:00Z", "2026-02-01T00:00:01Z"});
    made.duration_s = pick(4) / 3.0;
    made.trainee_id = one_of({"", "u1", "u2"});
    made.trainee = one_of({"", "\xc3\x96zg\xc3\xbcr", "100%_sure\\", "O'Brien", "b", "B"});
    made.study = one_of({"", "pilot"});
    made.participant = one_of({"", "P-01"});
    made.title = one_of({"", "Second try"});
    made.outcome = one_of({"", "pass", "fail", "undecided"});
    if (pick(3) > 0) made.points = pick(4) * 100.0 / 3.0;
    return made;
  }
  SessionQuery query() {
    SessionQuery made;
    if (pick(3) == 0) made.states = {"fault", "stopped"};
    if (pick(4) == 0) made.outcomes = {one_of({"pass", "none"}), one_of({"fail", "undecided"})};
    if (pick(4) == 0) made.points_from = pick(4) * 100.0 / 3.0;
    if (pick(4) == 0) made.points_to = pick(4) * 100.0 / 3.0;
    made.case_id = one_of({"", "", "demo"});
    made.trainee_id = one_of({"", "", "u1"});
    made.study = one_of({"", "", "pilot"});
    made.participant = one_of({"", "", "", "P-01"});
    made.outside_studies = pick(5) == 0;
    made.created_from = one_of({"", "", "2026-02", "2026-02-01T00:00:00Z"});
    made.created_before = one_of({"", "", "2026-02-01T00:00:01Z"});
    made.text = one_of({"", "", "SECOND", "\xc3\xb6ZG", "%", "_", "\\", "'", "s1", "demo try"});
    made.order = static_cast<SessionOrder>(pick(6));
    made.descending = pick(2) == 0;
    made.limit = static_cast<size_t>(1 + pick(9));
    return made;
  }
  int pick(int below) { return std::uniform_int_distribution<int>(0, below - 1)(random_); }
  std::string one_of(const std::vector<std::string>& words) {
    return words[static_cast<size_t>(pick(static_cast<int>(words.size())))];
  }

 private:
  std::mt19937 random_;
};

TYPED_TEST(SessionIndexTest, FindsPageByPageWhatItsWordsSay) {
  RandomSessions random(test::seed());
  std::vector<SessionRow> all;
  for (int number = 0; number < 120; ++number) all.push_back(random.row(number));
  SessionIndex index(this->database());
  index.put(all);
  for (int round = 0; round < 60; ++round) {
    SessionQuery query = random.query();
    std::vector<std::string> except;
    for (int i = random.pick(4); i > 0; --i) except.push_back(all[static_cast<size_t>(random.pick(120))].id);
    std::vector<SessionRow> expected;
    for (const SessionRow& each : all)
      if (matches(query, each) && std::find(except.begin(), except.end(), each.id) == except.end())
        expected.push_back(each);
    std::sort(expected.begin(), expected.end(),
              [&](const auto& a, const auto& b) { return precedes(query, a, b); });
    std::vector<SessionRow> got;
    for (bool more = true; more;) {
      auto found = index.find(query, except);
      ASSERT_EQ(found.total, expected.size()) << query.text;
      more = found.rows.size() > query.limit;
      if (more) found.rows.pop_back();
      got.insert(got.end(), found.rows.begin(), found.rows.end());
      if (more) query.cursor = cursor_behind(query, got.back());
    }
    ASSERT_EQ(got, expected) << "text '" << query.text << "', order " << static_cast<int>(query.order);
  }
}

}  // namespace
}  // namespace ream::store
