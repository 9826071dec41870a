#include "app/cli/case_path.hpp"
#include "app/rig.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::app {
namespace {

TEST(CasePath, BareNamesAreLookedUpAndPathsAreTaken) {
  EXPECT_EQ(case_path("knee", "/data"), "/data/cases/knee");
  EXPECT_EQ(case_path("./knee", "/data"), "./knee");
  EXPECT_EQ(case_path("/elsewhere/knee", "/data"), "/elsewhere/knee");
  EXPECT_EQ(case_path(".", "/data"), ".");
}

TEST(FindCase, UnknownAndBrokenCasesAreNamed) {
  const test::TemporaryFolder folder;
  test::expect_error(ErrorKind::not_found, "knee", [&] { find_case("knee", folder.path()); });
  test::expect_error(ErrorKind::not_found, "absent",
                     [&] { find_case((folder.path() / "absent").string(), folder.path()); });
  folder.write("cases/broken/case.json", "{\"id\": ");
  test::expect_error(ErrorKind::invalid_input, "case.json", [&] { find_case("broken", folder.path()); });
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"cases"}) << "looking for a case makes nothing";
}

}  // namespace
}  // namespace ream::app
