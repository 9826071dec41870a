#include "session/simulation/find_case.hpp"

#include "core/data_folder.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_bone.hpp"

namespace ream::session {
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

TEST(FindCase, SessionsOnOneCaseShareItsDensities) {
  const test::TemporaryFolder folder;
  for (const std::string name : {"demo", "knee"}) {
    case_::Case c;
    c.id = c.name = c.source = name;
    c.bone = test::slab({24, 24, 24}, 0.5, 4.0, 0.6);
    case_::save_case(c, cases_folder(folder.path()) / name);
    const case_::Case first = find_case(name, folder.path()), second = find_case(name, folder.path());
    EXPECT_TRUE(first.bone.density.shares_with(second.bone.density)) << name;
    EXPECT_EQ(first.id, name);
  }
}

}  // namespace
}  // namespace ream::session
