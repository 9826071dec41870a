#include "app/open_database.hpp"

#include <stdlib.h>

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

}  // namespace
}  // namespace ream::app
