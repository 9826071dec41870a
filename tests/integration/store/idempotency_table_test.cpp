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

}  // namespace
}  // namespace ream::store
