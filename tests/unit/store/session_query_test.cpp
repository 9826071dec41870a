#include "store/session_query.hpp"

#include <gtest/gtest.h>

#include "support/expect_error.hpp"

namespace ream::store {
namespace {

SessionRow row(const std::string& id, double duration_s) {
  SessionRow made;
  made.id = id;
  made.duration_s = duration_s;
  made.trainee = "two\nlines";
  return made;
}

TEST(SessionQuery, ACursorKeepsThePlace) {
  for (const char* word : {"created_utc", "duration_s", "case", "trainee", "state", "points"}) {
    SessionQuery query;
    query.order = session_order_from(word).value();
    EXPECT_EQ(place_of_cursor(query), std::nullopt);
    const SessionRow here = row("m", 0.1 + 0.2), smaller = row("l", 0.1 + 0.2), larger = row("n", 0.1 + 0.2);
    query.cursor = cursor_behind(query, here);
    const SessionPlace place = place_of_cursor(query).value();
    EXPECT_FALSE(behind(query, place, here)) << word;
    EXPECT_TRUE(behind(query, place, smaller)) << word;
    EXPECT_FALSE(behind(query, place, larger)) << word;
  }
  EXPECT_EQ(session_order_from("size"), std::nullopt);
}

TEST(SessionQuery, WithoutPointsStandsBelowNone) {
  SessionRow best = row("a", 1.0), worst = row("b", 1.0), unjudged = row("c", 1.0);
  best.points = 100.0;
  worst.points = 0.0;
  SessionQuery query;
  query.order = SessionOrder::points;
  EXPECT_TRUE(precedes(query, best, worst));
  EXPECT_TRUE(precedes(query, worst, unjudged));
  query.points_to = 100.0;
  EXPECT_TRUE(matches(query, worst));
  EXPECT_FALSE(matches(query, unjudged)) << "a session without points has neither few nor many";
  query.points_to.reset();
  query.outcomes = {"none"};
  EXPECT_TRUE(matches(query, unjudged));
  unjudged.outcome = "pass";
  EXPECT_FALSE(matches(query, unjudged));
}

TEST(SessionQuery, ACursorOfAnotherListIsRefused) {
  SessionQuery query;
  const std::string cursor = cursor_behind(query, row("m", 1.0));
  SessionQuery other = query;
  other.descending = false;
  other.cursor = cursor;
  test::expect_error(ErrorKind::invalid_input, "cursor", [&] { place_of_cursor(other); });
  for (const std::string& bad :
       {cursor.substr(1), cursor.substr(0, 20), std::string("zz"), std::string("00"), cursor + "00"}) {
    query.cursor = bad;
    test::expect_error(ErrorKind::invalid_input, "cursor", [&] { place_of_cursor(query); });
  }
}

TEST(SessionQuery, FoldsLettersOfManyScripts) {
  EXPECT_EQ(folded("ABC xyz 09"), "abc xyz 09");
  EXPECT_EQ(folded("\xc3\x96ZG\xc3\x9cR"), "\xc3\xb6zg\xc3\xbcr");
  EXPECT_EQ(folded("\xd0\x96\xce\xa9"), "\xd0\xb6\xcf\x89");
  const std::string odd("\xff\xc3 \0A", 5);
  EXPECT_EQ(folded(odd), std::string("\xff\xc3 \0a", 5));
}

TEST(SessionQuery, WordsAreFoundInAnyOrderAndCase) {
  SessionRow session = row("k3x", 1.0);
  session.title = "Second try";
  session.case_id = "left-b2";
  SessionQuery query;
  for (const char* text : {"", "  ", "try second", "B2 K3X", "LINES"}) {
    query.text = text;
    EXPECT_TRUE(matches(query, session)) << text;
  }
  for (const char* text : {"third", "try third", "k3x\nleft"}) {
    query.text = text;
    EXPECT_EQ(matches(query, session), std::string(text) == "k3x\nleft") << text;
  }
}

}  // namespace
}  // namespace ream::store
