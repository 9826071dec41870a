#include "store/login_attempt_table.hpp"

#include "support/test_databases.hpp"

namespace ream::store {
namespace {

template <typename Store>
class LoginAttemptTableTest : public test::TestDatabase<Store> {
 protected:
  LoginAttemptTable attempts{this->database()};
};
TYPED_TEST_SUITE(LoginAttemptTableTest, test::BothStores, test::StoreNames);

constexpr int64_t noon_ms = 1'769'860'800'000;

TYPED_TEST(LoginAttemptTableTest, CountsFailuresUnderEachKey) {
  this->attempts.note_failure({{"a"}, {"b"}}, noon_ms, 0);
  this->attempts.note_failure({{"a", noon_ms}}, noon_ms + 5, 0);
  const auto found = this->attempts.failures({"a", "b", "c"});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found.at("a").failures, 2);
  EXPECT_EQ(found.at("a").last_ms, noon_ms + 5);
  EXPECT_EQ(found.at("b").failures, 1);
  this->attempts.forget_failures("a");
  EXPECT_EQ(this->attempts.failures({"a", "b"}).size(), 1u);
}

TYPED_TEST(LoginAttemptTableTest, CountsAnewAfterAWhile) {
  this->attempts.note_failure({{"a"}, {"b"}}, noon_ms, 0);
  this->attempts.note_failure({{"a", noon_ms + 1}, {"b", noon_ms}}, noon_ms + 1000, 0);
  const auto found = this->attempts.failures({"a", "b"});
  EXPECT_EQ(found.at("a").failures, 1);
  EXPECT_EQ(found.at("b").failures, 2);
}

TYPED_TEST(LoginAttemptTableTest, OldRowsAreRemoved) {
  this->attempts.note_failure({{"a"}}, noon_ms, 0);
  this->attempts.note_failure({{"b"}}, noon_ms + 1000, noon_ms + 1);
  EXPECT_EQ(this->attempts.failures({"a", "b"}).size(), 1u);
}

TYPED_TEST(LoginAttemptTableTest, ForgetsAllKeysOfOneBeginning) {
  this->attempts.note_failure({{"anna_%"}, {"anna_%@here"}, {"annax%@here"}, {"ben"}}, noon_ms, 0);
  this->attempts.forget_failures("anna_%");
  EXPECT_EQ(this->attempts.failures({"anna_%", "anna_%@here", "annax%@here", "ben"}).size(), 2u);
}

TYPED_TEST(LoginAttemptTableTest, KnowsPlacesForAWhile) {
  EXPECT_FALSE(this->attempts.knows_place("p", 0));
  this->attempts.note_place("p", noon_ms, 0);
  EXPECT_TRUE(this->attempts.knows_place("p", noon_ms));
  EXPECT_FALSE(this->attempts.knows_place("p", noon_ms + 1));
  this->attempts.note_place("p", noon_ms + 7, 0);
  EXPECT_TRUE(this->attempts.knows_place("p", noon_ms + 7));
  this->attempts.note_place("q", noon_ms + 9, noon_ms + 8);
  EXPECT_FALSE(this->attempts.knows_place("p", 0));
}

}  // namespace
}  // namespace ream::store
