#include <gtest/gtest.h>

#include "core/atomic_file.hpp"
#include "core/file.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;
using test::expect_error;

void put(const AtomicFolder& folder, const std::string& text) {
  write_file_atomically(folder.path() / "a", text);
}

TEST(AtomicFolder, IsSeenOnlyWhenCommitted) {
  const test::TemporaryFolder parent;
  const fs::path out = parent.path() / "out";
  AtomicFolder folder(out);
  put(folder, "new");
  EXPECT_FALSE(fs::exists(out));
  folder.commit();
  EXPECT_EQ(read_text_file(out / "a"), "new");
  EXPECT_EQ(parent.entries(), Names{"out"});
}

TEST(AtomicFolder, LeavesNothingWhenGivenUp) {
  const test::TemporaryFolder parent;
  { put(AtomicFolder(parent.path() / "out"), "half"); }
  EXPECT_EQ(parent.entries(), Names{});
}

TEST(AtomicFolder, TakesTheNameWithATrailingSlash) {
  const test::TemporaryFolder parent;
  AtomicFolder folder(parent.path() / "out" / "");
  put(folder, "new");
  EXPECT_FALSE(fs::exists(parent.path() / "out"));
  folder.commit();
  EXPECT_EQ(read_text_file(parent.path() / "out" / "a"), "new");
  EXPECT_EQ(parent.entries(), Names{"out"});
}

TEST(AtomicFolder, FillsAnEmptyFolder) {
  const test::TemporaryFolder parent;
  fs::create_directory(parent.path() / "out");
  AtomicFolder folder(parent.path() / "out");
  put(folder, "new");
  folder.commit();
  EXPECT_EQ(read_text_file(parent.path() / "out" / "a"), "new");
  EXPECT_EQ(parent.entries(), Names{"out"});
}

TEST(AtomicFolder, TakesTheParentsItMadeAwayWhenGivenUp) {
  const test::TemporaryFolder parent;
  fs::create_directory(parent.path() / "kept");
  { put(AtomicFolder(parent.path() / "deep" / "er" / "out"), "half"); }
  { put(AtomicFolder(parent.path() / "kept" / "out"), "half"); }
  EXPECT_EQ(parent.entries(), Names{"kept"});
}

TEST(AtomicFolder, MakesMissingParents) {
  const test::TemporaryFolder parent;
  AtomicFolder folder(parent.path() / "deep" / "er" / "out");
  put(folder, "new");
  folder.commit();
  EXPECT_EQ(read_text_file(parent.path() / "deep" / "er" / "out" / "a"), "new");
}

TEST(AtomicFolder, RefusesWhatIsInTheWay) {
  const test::TemporaryFolder parent;
  parent.write("full/b", "old");
  const fs::path file = parent.write("file", "old");
  expect_error(ErrorKind::conflict, "full", [&] { AtomicFolder(parent.path() / "full"); });
  expect_error(ErrorKind::conflict, "file", [&] { AtomicFolder(file, true); });
  expect_error(ErrorKind::io, "out", [&] { AtomicFolder(file / "out"); });
  EXPECT_EQ(read_text_file(parent.path() / "full" / "b"), "old");
}

TEST(AtomicFolder, ReplacesAWholeFolderWhenAsked) {
  const test::TemporaryFolder parent;
  parent.write("out/b", "old");
  AtomicFolder folder(parent.path() / "out", true);
  put(folder, "new");
  EXPECT_EQ(read_text_file(parent.path() / "out" / "b"), "old");
  folder.commit();
  EXPECT_FALSE(fs::exists(parent.path() / "out" / "b"));
  EXPECT_EQ(read_text_file(parent.path() / "out" / "a"), "new");
  EXPECT_EQ(parent.entries(), Names{"out"});
}

TEST(AtomicFolder, KeepsTheOldFolderWhenItCannotBeReplaced) {
  const test::TemporaryFolder parent;
  parent.write("out/b", "old");
  {
    AtomicFolder folder(parent.path() / "out", true);
    fs::remove_all(folder.path());
    expect_error(ErrorKind::io, "out", [&] { folder.commit(); });
  }
  EXPECT_EQ(read_text_file(parent.path() / "out" / "b"), "old");
  EXPECT_EQ(parent.entries(), Names{"out"});
}

}  // namespace
}  // namespace ream
