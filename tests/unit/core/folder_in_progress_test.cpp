#include <gtest/gtest.h>

#include "core/file.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;
using test::expect_error;

void put(const FolderInProgress& folder, const std::string& text) {
  write_file_atomically(folder.path() / "a", text);
}

TEST(FolderInProgress, IsSeenOnlyWhenCommitted) {
  const test::TemporaryFolder parent;
  const fs::path out = parent.path() / "out";
  FolderInProgress folder(out);
  put(folder, "new");
  EXPECT_FALSE(fs::exists(out));
  folder.commit();
  EXPECT_EQ(read_text_file(out / "a"), "new");
  EXPECT_EQ(parent.entries(), Names{"out"});
}

TEST(FolderInProgress, LeavesNothingWhenGivenUp) {
  const test::TemporaryFolder parent;
  { put(FolderInProgress(parent.path() / "out"), "half"); }
  EXPECT_EQ(parent.entries(), Names{});
}

TEST(FolderInProgress, TakesTheNameWithATrailingSlash) {
  const test::TemporaryFolder parent;
  FolderInProgress folder(parent.path() / "out" / "");
  put(folder, "new");
  EXPECT_FALSE(fs::exists(parent.path() / "out"));
  folder.commit();
  EXPECT_EQ(read_text_file(parent.path() / "out" / "a"), "new");
  EXPECT_EQ(parent.entries(), Names{"out"});
}

TEST(FolderInProgress, FillsAnEmptyFolder) {
  const test::TemporaryFolder parent;
  fs::create_directory(parent.path() / "out");
  FolderInProgress folder(parent.path() / "out");
  put(folder, "new");
  folder.commit();
  EXPECT_EQ(read_text_file(parent.path() / "out" / "a"), "new");
  EXPECT_EQ(parent.entries(), Names{"out"});
}

TEST(FolderInProgress, TakesTheParentsItMadeAwayWhenGivenUp) {
  const test::TemporaryFolder parent;
  fs::create_directory(parent.path() / "kept");
  { put(FolderInProgress(parent.path() / "deep" / "er" / "out"), "half"); }
  { put(FolderInProgress(parent.path() / "kept" / "out"), "half"); }
  EXPECT_EQ(parent.entries(), Names{"kept"});
}

TEST(FolderInProgress, MakesMissingParents) {
  const test::TemporaryFolder parent;
  FolderInProgress folder(parent.path() / "deep" / "er" / "out");
  put(folder, "new");
  folder.commit();
  EXPECT_EQ(read_text_file(parent.path() / "deep" / "er" / "out" / "a"), "new");
}

TEST(FolderInProgress, RefusesWhatIsInTheWay) {
  const test::TemporaryFolder parent;
  parent.write("full/b", "old");
  const fs::path file = parent.write("file", "old");
  expect_error(ErrorKind::conflict, "full", [&] { FolderInProgress(parent.path() / "full"); });
  expect_error(ErrorKind::conflict, "file", [&] { FolderInProgress(file, true); });
  expect_error(ErrorKind::io, "out", [&] { FolderInProgress(file / "out"); });
  EXPECT_EQ(read_text_file(parent.path() / "full" / "b"), "old");
}

TEST(FolderInProgress, ReplacesAWholeFolderWhenAsked) {
  const test::TemporaryFolder parent;
  parent.write("out/b", "old");
  FolderInProgress folder(parent.path() / "out", true);
  put(folder, "new");
  EXPECT_EQ(read_text_file(parent.path() / "out" / "b"), "old");
  folder.commit();
  EXPECT_FALSE(fs::exists(parent.path() / "out" / "b"));
  EXPECT_EQ(read_text_file(parent.path() / "out" / "a"), "new");
  EXPECT_EQ(parent.entries(), Names{"out"});
}

TEST(FolderInProgress, KeepsTheOldFolderWhenItCannotBeReplaced) {
  const test::TemporaryFolder parent;
  parent.write("out/b", "old");
  {
    FolderInProgress folder(parent.path() / "out", true);
    fs::remove_all(folder.path());
    expect_error(ErrorKind::io, "out", [&] { folder.commit(); });
  }
  EXPECT_EQ(read_text_file(parent.path() / "out" / "b"), "old");
  EXPECT_EQ(parent.entries(), Names{"out"});
}

}  // namespace
}  // namespace ream
