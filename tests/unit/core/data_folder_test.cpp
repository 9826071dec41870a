#include "core/data_folder.hpp"

#include <stdlib.h>

#include <optional>

#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream {
namespace {

/// Sets (or removes) an environment variable while it lives.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) {
    if (const char* old = ::getenv(name)) old_ = old;
    set(value);
  }
  ~Environment() { set(old_ ? old_->c_str() : nullptr); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  void set(const char* value) {
    if (value != nullptr)
      ::setenv(name_, value, 1);
    else
      ::unsetenv(name_);
  }
  const char* name_;
  std::optional<std::string> old_;
};

TEST(DataFolder, TheOptionComesFirstThenReamDataThenHome) {
  const Environment home("HOME", "/home/somebody");
  const Environment data("REAM_DATA", "/srv/ream");
  EXPECT_EQ(data_folder("/chosen"), "/chosen");
  EXPECT_EQ(data_folder({}), "/srv/ream");
  for (const char* none : {static_cast<const char*>(nullptr), ""}) {
    const Environment without("REAM_DATA", none);
    EXPECT_EQ(data_folder({}), "/home/somebody/.local/share/ream");
  }
}

TEST(DataFolder, SaysWhatToDoWithoutAny) {
  const Environment home("HOME", nullptr);
  const Environment data("REAM_DATA", nullptr);
  test::expect_error(ErrorKind::usage, "--data", [] { data_folder({}); });
}

TEST(DataFolder, CasesAndSessionsAreBelowIt) {
  EXPECT_EQ(cases_folder("/srv/ream"), "/srv/ream/cases");
  EXPECT_EQ(sessions_folder("/srv/ream"), "/srv/ream/sessions");
}

TEST(DataFolder, IsForItsOwnerAlone) {
  const test::TemporaryFolder parent;
  const std::filesystem::path data = parent.path() / "deep" / "data";
  make_data_folder(data);
  EXPECT_EQ(std::filesystem::status(data).permissions(), std::filesystem::perms::owner_all);
  EXPECT_EQ(data_folder_warning(data), "");
  EXPECT_EQ(data_folder_warning(parent.path() / "none"), "");
  std::filesystem::permissions(data, std::filesystem::perms(0750));
  EXPECT_NE(data_folder_warning(data).find("chmod 700 " + data.string()), std::string::npos);
  make_data_folder(data);
  EXPECT_EQ(std::filesystem::status(data).permissions(), std::filesystem::perms(0750))
      << "as its owner has it";
}

}  // namespace
}  // namespace ream
