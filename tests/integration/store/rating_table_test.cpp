#include "store/rating_table.hpp"

#include "store/study_table.hpp"
#include "support/expect_error.hpp"
#include "support/test_databases.hpp"

namespace ream::store {
namespace {

template <typename Store>
class RatingTableTest : public test::TestDatabase<Store> {
 protected:
  void SetUp() override {
    for (const char* id : {"s1", "s2"})
      studies_.add(
          {id, "A study", "", "open", std::string("join-") + id, "{}", "", "2026-01-01T12:00:00Z", "", ""});
  }
  std::string labels(const std::string& study) {
    std::string all;
    for (const RaterRow& rater : ratings_.raters(study)) all += rater.label + " ";
    return all;
  }
  StudyTable studies_{this->database()};
  RatingTable ratings_{this->database()};
};
TYPED_TEST_SUITE(RatingTableTest, test::BothStores, test::StoreNames);

TYPED_TEST(RatingTableTest, RatersAreNumberedInTheirStudy) {
  RatingTable& table = this->ratings_;
  EXPECT_EQ(table.add_rater("s1", "u1", "Ines"), "R1");
  EXPECT_EQ(table.add_rater("s2", "u1", "Ines"), "R1");
  for (int i = 2; i <= 11; ++i)
    EXPECT_EQ(table.add_rater("s1", "u" + std::to_string(i), ""), "R" + std::to_string(i));
  EXPECT_EQ(this->labels("s1"), "R1 R2 R3 R4 R5 R6 R7 R8 R9 R10 R11 ");
  test::expect_error(ErrorKind::conflict, "", [&] { table.add_rater("s1", "u1", "Ines"); });
  EXPECT_EQ(table.labels_of("u1"), (std::map<std::string, std::string>{{"s1", "R1"}, {"s2", "R1"}}));
  EXPECT_TRUE(table.labels_of("").empty());
}

TYPED_TEST(RatingTableTest, ARatingTakesThePlaceOfTheOneBefore) {
  RatingTable& table = this->ratings_;
  table.add_rater("s1", "u1", "Ines");
  table.set("s1", {"R1", "abcd2345", "{}"});
  table.set("s1", {"R1", "abcd2345", R"({"a": 1})"});
  table.set("s1", {"R1", "abcd2346", "{}"});
  ASSERT_EQ(table.ratings("s1").size(), 2u);
  EXPECT_EQ(table.ratings("s1")[0].answers, R"({"a": 1})");
  EXPECT_TRUE(table.ratings("s2").empty());
  test::expect_error(ErrorKind::not_found, "R2", [&] { table.set("s1", {"R2", "abcd2345", "{}"}); });
  table.forget_user("u1");
  EXPECT_EQ(table.raters("s1").at(0).user_id, "");
  EXPECT_EQ(table.raters("s1").at(0).name, "");
  EXPECT_EQ(table.ratings("s1").size(), 2u) << "what was said stays";
  table.remove_rater("s1", "R1");
  EXPECT_TRUE(table.ratings("s1").empty());
  test::expect_error(ErrorKind::not_found, "R1", [&] { table.remove_rater("s1", "R1"); });
}

TYPED_TEST(RatingTableTest, PlacesOfTheRandomSequenceAreTakenOnce) {
  StudyTable& table = this->studies_;
  const auto arm_at = [](int64_t place) { return "arm" + std::to_string(place); };
  const auto enrol = [&](const std::string& code, const std::string& stratum) {
    return table.enrol({code, "s1", stratum, 0, ""}, std::nullopt, stratum, arm_at);
  };
  EXPECT_EQ(enrol("A", "novice"), "arm0");
  EXPECT_EQ(enrol("B", "novice"), "arm1");
  EXPECT_EQ(enrol("C", "expert"), "arm0");
  table.remove_participant("s1", "B");
  EXPECT_EQ(enrol("D", "novice"), "arm2") << "who withdrew keeps the place";
  test::expect_error(ErrorKind::conflict, "", [&] { enrol("A", "novice"); });
  EXPECT_EQ(enrol("E", "novice"), "arm3") << "a refused enrolment takes none";
  EXPECT_EQ(table.participant("s1", "D")->arm, "arm2");
  for (const char* code : {"A", "C", "D", "E"}) table.remove_participant("s1", code);
  this->ratings_.add_rater("s1", "u1", "Ines");
  table.remove("s1");
  EXPECT_FALSE(table.find("s1"));
}

}  // namespace
}  // namespace ream::store
