#include "core/folder_listing.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "core/error.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream {
namespace {

namespace fs = std::filesystem;

TEST(FolderListing, IsByNameAndOfAllThatLiesThere) {
  const test::TemporaryFolder folder;
  for (const char* name : {"b", "a", ".hidden", "c/below"}) folder.write(name, "");
  fs::create_symlink("nowhere", folder.path() / "link");
  const fs::path& at = folder.path();
  EXPECT_EQ(paths_in(at), (std::vector<fs::path>{at / ".hidden", at / "a", at / "b", at / "c", at / "link"}));
  EXPECT_EQ(paths_in(at / "c"), std::vector<fs::path>{at / "c/below"});
}

TEST(FolderListing, OfNoFolderIsEmptyButOfAFileAnError) {
  const test::TemporaryFolder folder;
  folder.write("file", "");
  EXPECT_TRUE(paths_in(folder.path() / "nowhere").empty());
  test::expect_error(ErrorKind::io, "file: Not a directory", [&] { paths_in(folder.path() / "file"); });
  // Of a disk that is not mounted.
  fs::create_symlink("nowhere", folder.path() / "link");
  test::expect_error(ErrorKind::io, "leads nowhere", [&] { paths_in(folder.path() / "link"); });
}

TEST(FolderListing, ThatCannotBeMadeIsNotTakenForAnEmptyFolder) {
  const test::TemporaryFolder folder;
  folder.write("file", "");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const rlimit none{0, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
  test::expect_error(ErrorKind::io, "Too many open files", [&] { paths_in(folder.path()); });
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_EQ(paths_in(folder.path()).size(), 1u);
}

}  // namespace
}  // namespace ream
