#include "app/person_data.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/data_folder.hpp"
#include "core/file.hpp"
#include "core/file_lock.hpp"
#include "session/folder/recorded_annotations.hpp"
#include "store/idempotency_table.hpp"
#include "store/study_table.hpp"
#include "store/table_files.hpp"
#include "support/example_log.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_databases.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

template <typename Store>
class PersonDataTest : public test::TestDatabase<Store> {
 protected:
  static access::AccessOptions cheap() {
    access::AccessOptions options;
    options.cost = {1, size_t{8} << 10};
    return options;
  }
  access::User add(const std::string& name, const std::string& shown, access::Role role) {
    return access_control.users.add({name, shown, role, access::Secret(std::string_view("a good password"))});
  }
  void put(const std::string& folder, const std::string& trainee_id, const std::string& trainee) const {
    data.write(folder + "/session.json", json{{"case", "demo"},
                                              {"script", "demo"},
                                              {"state", "finished"},
                                              {"created_utc", "2026-01-31T12:00:00Z"},
                                              {"trainee_id", trainee_id},
                                              {"trainee", trainee}}
                                             .dump());
  }
  /// Whether a file of the data folder holds that text.
  bool is_in_a_file(const std::string& text) const {
    for (const auto& entry : fs::recursive_directory_iterator(data.path()))
      if (entry.is_regular_file() && read_text_file(entry.path()).find(text) != std::string::npos)
        return true;
    return false;
  }
  ForgetReport forget() { return forget_person(this->database(), access_control, data.path(), tina); }

  const test::TemporaryFolder data;
  access::AccessControl access_control{this->database(), cheap()};
  const access::User anna = add("anna", "Anna", access::Role::operator_),
                     tina = add("tina", "Tina Tester", access::Role::trainee);
};
TYPED_TEST_SUITE(PersonDataTest, test::BothStores, test::StoreNames);

TYPED_TEST(PersonDataTest, NothingOfAForgottenPersonStays) {
  this->put("sessions/s1", this->tina.id, "Tina Tester");
  this->put("trash/s2", this->tina.id, "Tina Tester");
  this->put("sessions/s3", this->anna.id, "Anna");
  store::IdempotencyTable answers(this->database());
  answers.put({this->tina.id, "k", "print", 201, "application/json", "", "Tina Tester", 1});
  answers.put(
      {this->anna.id, "k", "print", 201, "application/json", "", "{\"id\": \"" + this->tina.id + "\"}", 1});
  this->access_control.audit.note({this->tina.id, "Tina Tester", "trainee", "c1", "10.0.0.9"}, "login", "",
                                  "");
  this->access_control.audit.note({this->anna.id, "Anna", "operator", "c2", "10.0.0.1"}, "user.add",
                                  this->tina.id, "tina as trainee");
  const ForgetReport report = this->forget();
  this->access_control.audit.note({}, "user.forget", this->tina.id, "");
  EXPECT_EQ(report.sessions, 2u);
  EXPECT_EQ(report.audit_rows, 2);
  EXPECT_TRUE(report.left.empty());
  EXPECT_FALSE(this->access_control.users.find_by_name("tina"));
  EXPECT_FALSE(this->is_in_a_file("Tina"));
  EXPECT_TRUE(this->is_in_a_file("Anna"));
  EXPECT_FALSE(answers.find(this->tina.id, "k"));
  EXPECT_FALSE(answers.find(this->anna.id, "k"));
  for (const store::AuditRow& row : this->access_control.audit.list(INT64_MAX, 10))
    EXPECT_EQ((row.name + row.detail + row.address).find_first_of("Tt9"), std::string::npos) << row.number;
  EXPECT_TRUE(this->access_control.audit.check().faults.empty());
}

TYPED_TEST(PersonDataTest, NothingStaysInRemarksBlackBoxesStudiesAndWhatWasMovedAside) {
  this->put("sessions/s1", this->tina.id, "Tina Tester");
  this->put("sessions/s3", this->anna.id, "Anna");
  for (const std::string session : {"sessions/s1", "sessions/s3"}) {
    test::write_example_log(record::create_log_file(this->data.path() / session / "recording.ream"));
    for (const std::string author : {"Tina Tester", "Anna"})
      session::annotate_recording(this->data.path() / session, {"too deep", author, {}, {}});
  }
  this->data.write("sessions/s1/black-box-7.csv", "tick,thrust_n\n7,1\n");
  store::StudyTable studies(this->database());
  studies.add({"s", "study", "", "open", "join", "{}", "", "2026-01-31T12:00:00Z", "", ""});
  studies.enrol({"code-1", "s", "", 0, ""}, store::PersonRow{"code-1", this->tina.id, "Tina Tester"});
  studies.set_answers("s", "code-1", R"({"liked": 4})");
  this->access_control.audit.note({this->tina.id, "Tina Tester", "trainee", "c1", "10.0.0.9"}, "login", "",
                                  "");
  const fs::path aside = this->data.path() / "before-restore-2026-01-31T12-00-00Z";
  fs::create_directories(aside / "tables");
  store::write_table_files(this->database(), aside / "tables");
  fs::copy(this->data.path() / "sessions", aside / "sessions", fs::copy_options::recursive);
  this->data.write("before-restore-2025.tar.gz", "somebody's own archive");
  ASSERT_EQ(export_person(this->database(), this->access_control, this->data.path(), this->tina)
                .at("sessions")
                .size(),
            2u);
  test::expect_error(ErrorKind::not_found, "no data folder", [&] {
    export_person(this->database(), this->access_control, this->data.path() / "nowhere", this->tina);
  });
  const ForgetReport report = this->forget();
  EXPECT_TRUE(report.left.empty()) << report.left.front();
  EXPECT_FALSE(this->is_in_a_file("Tina"));
  EXPECT_FALSE(this->is_in_a_file("\"tina\""));
  EXPECT_FALSE(this->is_in_a_file("10.0.0.9"));
  EXPECT_TRUE(this->is_in_a_file("\"anna\"")) << "of others nothing goes";
  EXPECT_EQ(read_text_file(aside / "tables/users.jsonl").find(this->tina.id), std::string::npos);
  EXPECT_EQ(read_text_file(aside / "tables/credentials.jsonl").find(this->tina.id), std::string::npos);
  for (const fs::path& folder : {this->data.path(), aside})
    for (const char* session : {"sessions/s1", "sessions/s3"}) {
      const auto remarks = session::recorded_annotations(folder / session);
      ASSERT_EQ(remarks.size(), 3u) << session;
      EXPECT_EQ(remarks[1].author, "");
      EXPECT_EQ(remarks[1].words, "too deep");
      EXPECT_EQ(remarks[2].author, "Anna");
      EXPECT_TRUE(record::Recording(folder / session / "recording.ream").log().damage().empty());
    }
  EXPECT_TRUE(fs::exists(this->data.path() / "sessions/s1/black-box-7.csv"));
  EXPECT_EQ(studies.participant("s", "code-1")->answers, R"({"liked": 4})");
  EXPECT_FALSE(studies.person("s", "code-1"));
}

TYPED_TEST(PersonDataTest, IsNotBegunWhereItCannotBeDone) {
  test::expect_error(ErrorKind::conflict, "last operator", [&] {
    forget_person(this->database(), this->access_control, this->data.path(), this->anna);
  });
  const auto server = FileLock::attempt(serving_lock(this->data.path()));
  test::expect_error(ErrorKind::conflict, "a server runs", [&] { this->forget(); });
  EXPECT_TRUE(this->access_control.users.find_by_name("tina")->enabled);
}

TYPED_TEST(PersonDataTest, ASessionThatIsInUseKeepsTheUserForAnotherTry) {
  this->put("sessions/s1", this->tina.id, "Tina Tester");
  {
    const auto lock = FileLock::attempt(this->data.path() / "sessions/s1/lock");
    EXPECT_EQ(this->forget().left.size(), 1u);
    EXPECT_FALSE(this->access_control.users.find_by_name("tina")->enabled);
  }
  EXPECT_TRUE(this->forget().left.empty());
  EXPECT_FALSE(this->is_in_a_file("Tina"));
}

TYPED_TEST(PersonDataTest, TheExportHasAllPlacesAndNothingSecret) {
  this->put("sessions/s1", this->tina.id, "Tina Tester");
  this->put("trash/s2", "", "tina");
  this->put("sessions/s3", this->anna.id, "Anna");
  const auto token = this->access_control.credentials.issue(access::CredentialKind::token,
                                                            {this->tina.id, {}, "robot", "", ""});
  this->access_control.audit.note({this->tina.id, "Tina Tester", "trainee", "c1", "10.0.0.9"}, "login", "",
                                  "");
  const json told = export_person(this->database(), this->access_control, this->data.path(), this->tina);
  EXPECT_EQ(told.at("user").at("name"), "tina");
  EXPECT_EQ(told.at("sessions").size(), 2u);
  EXPECT_EQ(told.at("credentials").size(), 1u);
  EXPECT_EQ(told.at("audit").size(), 1u);
  EXPECT_EQ(told.dump().find(token.row.hash), std::string::npos);
  EXPECT_EQ(told.dump().find("argon2"), std::string::npos);
}

}  // namespace
}  // namespace ream::app
