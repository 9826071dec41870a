#include "store/idempotency_table.hpp"

#include "support/test_databases.hpp"

namespace ream::store {
namespace {

StoredResponse answer(const std::string& caller, const std::string& key, int64_t at_ms) {
  return {caller,
          key,
          "0123456789abcdef",
          201,
          "application/json",
          "/api/v1/sessions/abcd2345",
          "{\"title\": \"J\xc3\xb6rg's\"}",
          at_ms};
}

template <typename Store>
class IdempotencyTableTest : public test::TestDatabase<Store> {
 protected:
  IdempotencyTable answers{this->database()};
};
TYPED_TEST_SUITE(IdempotencyTableTest, test::BothStores, test::StoreNames);

TYPED_TEST(IdempotencyTableTest, GivesBackEveryColumnByCallerAndKey) {
  this->answers.put(answer("anna", "k1", 1'700'000'000'000));
  this->answers.put(answer("", "k1", 5));
  EXPECT_EQ(this->answers.find("anna", "k1"), answer("anna", "k1", 1'700'000'000'000));
  EXPECT_EQ(this->answers.find("", "k1"), answer("", "k1", 5));
  EXPECT_EQ(this->answers.find("anna", "k2"), std::nullopt);
  EXPECT_EQ(IdempotencyTable(*this->open_again()).find("", "k1"), answer("", "k1", 5));
}

TYPED_TEST(IdempotencyTableTest, ANewerAnswerTakesThePlaceAndOldOnesGo) {
  this->answers.put(answer("anna", "k1", 10));
  StoredResponse newer = answer("anna", "k1", 20);
  newer.body = "{}";
  newer.status = 202;
  this->answers.put(newer);
  EXPECT_EQ(this->answers.find("anna", "k1"), newer);
  this->answers.put(answer("ben", "k1", 19));
  this->answers.remove_before(20);
  EXPECT_EQ(this->answers.find("ben", "k1"), std::nullopt);
  EXPECT_EQ(this->answers.find("anna", "k1"), newer);
}

TYPED_TEST(IdempotencyTableTest, WhatTellsOfSomebodyOrSomethingIsForgotten) {
  this->answers.put(answer("anna", "by location", 10));
  StoredResponse told = answer("anna", "by body", 10);
  told.location.clear();
  told.body = R"({"about": "abcd2345"})";
  this->answers.put(told);
  StoredResponse other = told;
  other.key = "of another";
  other.body = R"({"about": "abcd"})";
  this->answers.put(other);
  this->answers.put(answer("abcd2345", "own", 10));
  this->answers.remove_about("abcd2345");
  for (const char* key : {"by location", "by body"}) EXPECT_FALSE(this->answers.find("anna", key)) << key;
  EXPECT_FALSE(this->answers.find("abcd2345", "own"));
  EXPECT_EQ(this->answers.find("anna", "of another"), other);
}

TYPED_TEST(IdempotencyTableTest, OneCallerKeepsOnlySoMuch) {
  StoredResponse big = answer("anna", "", 0);
  big.body = std::string(IdempotencyTable::max_bytes / 4, 'x');
  for (int i = 0; i < 6; ++i) {
    big.key = "big" + std::to_string(i);
    big.at_ms = 100 + i;
    this->answers.put(big);
  }
  this->answers.put(answer("ben", "k", 1));
  EXPECT_FALSE(this->answers.find("anna", "big0"));
  EXPECT_FALSE(this->answers.find("anna", "big1"));
  EXPECT_TRUE(this->answers.find("anna", "big2"));
  EXPECT_TRUE(this->answers.find("anna", "big5"));
  EXPECT_TRUE(this->answers.find("ben", "k")) << "is somebody else's";
  for (int64_t i = 0; i <= IdempotencyTable::max_answers; ++i)
    this->answers.put(answer("carl", "k" + std::to_string(i), 10 + i));
  EXPECT_FALSE(this->answers.find("carl", "k0"));
  EXPECT_TRUE(this->answers.find("carl", "k1"));
}

}  // namespace
}  // namespace ream::store
