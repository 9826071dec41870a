#include "app/open_database.hpp"

#include <stdlib.h>

#include "access/access_control.hpp"
#include "core/error.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::app {
namespace {

/// REAM_DB as long as it lives.
class EnvironmentUrl {
 public:
  explicit EnvironmentUrl(const char* url) { ::setenv("REAM_DB", url, 1); }
  ~EnvironmentUrl() { ::unsetenv("REAM_DB"); }
  EnvironmentUrl(const EnvironmentUrl&) = delete;
  EnvironmentUrl& operator=(const EnvironmentUrl&) = delete;
};

TEST(OpenDatabase, IsAFileInTheDataFolderUnlessSaidOtherwise) {
  EXPECT_EQ(database_url("", "/data"), "sqlite:/data/ream.db");
  const EnvironmentUrl environment("postgresql://me:secret@host/ream");
  EXPECT_EQ(database_url("", "/data"), "postgresql://me:secret@host/ream");
  EXPECT_EQ(database_url("sqlite:/other.db", "/data"), "sqlite:/other.db");
}

TEST(OpenDatabase, TakesNoPasswordFromTheCommandLine) {
  for (const char* url : {"postgresql://me:secret@host/ream", "postgresql://host/ream?password=secret"}) try {
      database_url(url, "/data");
      ADD_FAILURE() << url;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      EXPECT_EQ(std::string(error.what()).find("secret"), std::string::npos);
    }
}

TEST(OpenDatabase, MakesTheDataFolder) {
  const test::TemporaryFolder folder;
  open_database("", folder.path() / "new");
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "new/ream.db"));
}

/// A data folder with two sessions and a case.
class Reading : public testing::Test {
 protected:
  Reading() {
    for (const char* folder : {"sessions/s1", "sessions/s2", "cases/c1"})
      std::filesystem::create_directories(data() / folder);
    folder_.write("data/sessions/s1/recording.ream", "");
    folder_.write("elsewhere.ream", "");
  }

  std::filesystem::path data() const { return folder_.path() / "data"; }
  void add_user() {
    access::AccessControl(*open_database("", data()))
        .users.add(
            {"ben", "Ben", access::Role::operator_, access::Secret(std::string_view("a good password"))});
  }
  /// What the rows say, oldest first, but for that of the user.
  std::vector<std::string> rows() {
    std::vector<std::string> said;
    for (const store::AuditRow& row :
         access::AccessControl(*open_database("", data())).audit.list_from(0, 100))
      if (row.action.starts_with("session.") || row.action.starts_with("case."))
        said.push_back(row.name + ": " + row.action + ' ' + row.object + row.detail);
    return said;
  }

  test::TemporaryFolder folder_;
};

TEST_F(Reading, IsNotedOnceForEachCommand) {
  add_user();
  note_reading("", data(), "session.export", {"s1"});
  note_reading("", data(), "session.export", {(data() / "sessions/s1/recording.ream").string()});
  note_reading("", data(), "session.export", {(data() / "sessions/s1/../s2").string()});
  note_reading("", data(), "case.read", {"c1"});
  note_reading("", data(), "session.score.read", {"s1", "s2", "s1"});
  EXPECT_EQ(rows(), (std::vector<std::string>{
                        "command line: session.export s1", "command line: session.export s1",
                        "command line: session.export s2", "command line: case.read c1",
                        "command line: session.score.read s1", "command line: session.score.read s2"}));
}

TEST_F(Reading, OfWhatIsNotInTheDataFolderIsNotNoted) {
  add_user();
  for (const std::string& name : {(folder_.path() / "elsewhere.ream").string(), std::string("s3"),
                                  std::string(".."), (data() / "sessions").string(), std::string()})
    note_reading("", data(), "session.export", {name});
  EXPECT_EQ(rows(), std::vector<std::string>());
}

TEST_F(Reading, MakesNoDatabaseWhereNobodyLogsIn) {
  note_reading("", data(), "session.export", {"s1"});
  EXPECT_FALSE(std::filesystem::exists(data() / "ream.db"));
  open_database("", data());
  note_reading("", data(), "session.export", {"s1"});
  EXPECT_EQ(rows(), std::vector<std::string>());
}

}  // namespace
}  // namespace ream::app
