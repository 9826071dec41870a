#include "store/study_table.hpp"

#include "support/expect_error.hpp"
#include "support/test_databases.hpp"

namespace ream::store {
namespace {

using test::expect_error;
using Codes = std::vector<std::string>;

StudyRow study(const std::string& id) {
  return {id,
          "Study " + id,
          "Who reams best?",
          "open",
          "join-" + id,
          R"({"cases": ["demo"]})",
          R"({"id": "q"})",
          "2026-01-0" + id.substr(1) + "T12:00:00Z",
          "",
          ""};
}

template <typename Store>
class StudyTableTest : public test::TestDatabase<Store> {
 protected:
  Codes codes(const std::string& of) {
    Codes list;
    for (const auto& row : studies_.participants(of)) list.push_back(row.code);
    return list;
  }
  StudyTable studies_{this->database()};
};
TYPED_TEST_SUITE(StudyTableTest, test::BothStores);

TYPED_TEST(StudyTableTest, StudiesComeBackAsTheyWereKept) {
  StudyTable& table = this->studies_;
  EXPECT_TRUE(table.list().empty());
  table.add(study("s1"));
  table.add(study("s2"));
  const auto found = table.find("s1");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->name, "Study s1");
  EXPECT_EQ(found->description, "Who reams best?");
  EXPECT_EQ(found->state, "open");
  EXPECT_EQ(found->join_code, "join-s1");
  EXPECT_EQ(found->settings, R"({"cases": ["demo"]})");
  EXPECT_EQ(found->questionnaire, R"({"id": "q"})");
  EXPECT_EQ(found->created_utc, "2026-01-01T12:00:00Z");
  EXPECT_EQ(found->closed_utc, "");
  EXPECT_EQ(table.find_by_join_code("join-s2")->id, "s2");
  EXPECT_FALSE(table.find("s3"));
  EXPECT_FALSE(table.find_by_join_code("join-s3"));
  ASSERT_EQ(table.list().size(), 2u);
  EXPECT_EQ(table.list()[0].id, "s2") << "newest first";
}

TYPED_TEST(StudyTableTest, StudiesAreChangedAndRemoved) {
  StudyTable& table = this->studies_;
  table.add(study("s1"));
  StudyRow changed = study("s1");
  changed.name = "Größer – 手";
  changed.state = "closed";
  changed.closed_utc = "2026-02-01T00:00:00Z";
  changed.unblinded_utc = "2026-02-02T00:00:00Z";
  table.replace(changed);
  EXPECT_EQ(table.find("s1")->name, "Größer – 手");
  EXPECT_EQ(table.find("s1")->closed_utc, "2026-02-01T00:00:00Z");
  EXPECT_EQ(table.find("s1")->unblinded_utc, "2026-02-02T00:00:00Z");
  expect_error(ErrorKind::not_found, "s9", [&] { table.replace(study("s9")); });
  expect_error(ErrorKind::not_found, "s9", [&] { table.remove("s9"); });
  table.enrol({"K7-F3M", "s1", "novice", 0, ""}, std::nullopt);
  expect_error(ErrorKind::conflict, "", [&] { table.remove("s1"); });
  table.remove_participant("s1", "K7-F3M");
  table.remove("s1");
  EXPECT_FALSE(table.find("s1"));
}

TYPED_TEST(StudyTableTest, TwoStudiesCannotHaveOneIdOrJoinCode) {
  this->studies_.add(study("s1"));
  StudyRow twin = study("s2");
  twin.join_code = "join-s1";
  expect_error(ErrorKind::conflict, "", [&] { this->studies_.add(study("s1")); });
  expect_error(ErrorKind::conflict, "", [&] { this->studies_.add(twin); });
  EXPECT_EQ(this->studies_.list().size(), 1u);
}

TYPED_TEST(StudyTableTest, ParticipantsAreEnrolledOnce) {
  StudyTable& table = this->studies_;
  table.add(study("s1"));
  table.add(study("s2"));
  table.enrol({"K7-F3M", "s1", "novice", 2, ""}, PersonRow{"K7-F3M", "user-1", "Ada"});
  expect_error(ErrorKind::conflict, "", [&] {
    table.enrol({"K7-F3M", "s2", "expert", 0, ""}, std::nullopt);
  });
  expect_error(ErrorKind::conflict, "", [&] {
    table.enrol({"AA-222", "s1", "novice", 2, ""}, PersonRow{"AA-222", "user-1", "Ada"});
  });
  EXPECT_EQ(this->codes("s1"), Codes{"K7-F3M"}) << "the second enrolment left nothing behind";
  expect_error(ErrorKind::not_found, "s9", [&] {
    table.enrol({"AA-333", "s9", "novice", 0, ""}, std::nullopt);
  });
  table.enrol({"AA-444", "s2", "novice", 2, ""}, PersonRow{"AA-444", "user-1", "Ada"});
  table.enrol({"AA-555", "s1", "expert", 0, ""}, PersonRow{"AA-555", "", "The surgeon from Ulm"});
  table.enrol({"AA-666", "s1", "expert", 0, ""}, PersonRow{"AA-666", "", ""});
  EXPECT_EQ(this->codes("s1"), (Codes{"AA-555", "AA-666", "K7-F3M"}));
  EXPECT_EQ(table.count("s1"), 3);
  EXPECT_EQ(table.count("s2"), 1);
  EXPECT_EQ(table.count("s9"), 0);
}

TYPED_TEST(StudyTableTest, PersonsAreFoundOnlyInTheirStudy) {
  StudyTable& table = this->studies_;
  table.add(study("s1"));
  table.add(study("s2"));
  table.enrol({"K7-F3M", "s1", "novice", 2, ""}, PersonRow{"K7-F3M", "user-1", "Ada"});
  table.enrol({"AA-444", "s2", "novice", 2, ""}, PersonRow{"AA-444", "user-1", "Ada"});
  table.enrol({"AA-555", "s1", "expert", 0, ""}, std::nullopt);
  EXPECT_EQ(table.code_of("s1", "user-1"), "K7-F3M");
  EXPECT_EQ(table.code_of("s1", "user-2"), "");
  EXPECT_EQ(table.code_of("s1", ""), "");
  EXPECT_EQ(table.codes_of("user-1"),
            (std::map<std::string, std::string>{{"s1", "K7-F3M"}, {"s2", "AA-444"}}));
  ASSERT_EQ(table.persons("s1").size(), 1u);
  EXPECT_EQ(table.persons("s1")[0].name, "Ada");
  EXPECT_EQ(table.person("s1", "K7-F3M")->user_id, "user-1");
  EXPECT_FALSE(table.person("s2", "K7-F3M"));
  EXPECT_FALSE(table.person("s1", "AA-555"));
}

TYPED_TEST(StudyTableTest, AnswersAreKeptAndGoWithTheParticipant) {
  StudyTable& table = this->studies_;
  table.add(study("s1"));
  table.enrol({"K7-F3M", "s1", "expert", 120, ""}, PersonRow{"K7-F3M", "user-1", "Ada"});
  table.set_answers("s1", "K7-F3M", R"({"remarks": "schön – gut"})");
  const auto found = table.participant("s1", "K7-F3M");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->answers, R"({"remarks": "schön – gut"})");
  EXPECT_EQ(found->experience, "expert");
  EXPECT_EQ(found->procedures_done, 120);
  expect_error(ErrorKind::not_found, "K7", [&] { table.set_answers("s2", "K7-F3M", "{}"); });
  table.remove_participant("s1", "K7-F3M");
  EXPECT_FALSE(table.participant("s1", "K7-F3M"));
  EXPECT_EQ(table.code_of("s1", "user-1"), "");
  expect_error(ErrorKind::not_found, "K7", [&] { table.remove_participant("s1", "K7-F3M"); });
}

TYPED_TEST(StudyTableTest, AnotherProcessSeesTheSame) {
  this->studies_.add(study("s1"));
  const auto other = this->open_again();
  EXPECT_EQ(StudyTable(*other).list().size(), 1u);
}

}  // namespace
}  // namespace ream::store
