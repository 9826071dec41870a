#include "core/temporary_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/file_descriptor.hpp"
#include "support/temporary_folder.hpp"

namespace ream {
namespace {

/// So many descriptors may be open while it lives.
class FewDescriptors {
 public:
  explicit FewDescriptors(rlim_t count) {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const rlimit few{count, before_.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &few);
  }
  ~FewDescriptors() { ::setrlimit(RLIMIT_NOFILE, &before_); }

 private:
  rlimit before_{};
};

TEST(RemoveTree, TakesAwayWhatLiesDeeperThanDescriptorsAndNamesReach) {
  const test::TemporaryFolder folder;
  ASSERT_EQ(::mkdir((folder.path() / "top").c_str(), 0700), 0);
  {
    FileDescriptor place(::open((folder.path() / "top").c_str(), O_RDONLY | O_DIRECTORY));
    for (int level = 0; level < 2500; ++level) {
      ASSERT_EQ(::mkdirat(place.get(), "a", 0700), 0);
      ASSERT_EQ(::mkdirat(place.get(), "empty", 0), 0);
      const FileDescriptor file(::openat(place.get(), "file", O_CREAT | O_WRONLY, 0));
      place = FileDescriptor(::openat(place.get(), "a", O_RDONLY | O_DIRECTORY));
    }
  }
  const FewDescriptors few(32);
  EXPECT_TRUE(remove_tree(folder.path() / "top"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(RemoveTree, TakesManyFullFoldersBesideEachOther) {
  const test::TemporaryFolder folder;
  for (int i = 0; i < 3000; ++i) folder.write("top/" + std::to_string(i) + "/inner/file", "");
  const FewDescriptors few(32);
  EXPECT_TRUE(remove_tree(folder.path() / "top"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(RemoveTree, TakesLinksAwayAndDoesNotFollowThem) {
  const test::TemporaryFolder folder, other;
  other.write("kept/file", "kept");
  folder.write("top/inside/file", "");
  std::filesystem::create_symlink(other.path() / "kept", folder.path() / "top/inside/link");
  std::filesystem::create_symlink(other.path() / "kept", folder.path() / "link");
  EXPECT_TRUE(remove_tree(folder.path() / "top"));
  EXPECT_TRUE(remove_tree(folder.path() / "link"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_TRUE(std::filesystem::exists(other.path() / "kept/file"));
}

TEST(RemoveTree, TakesFilesAndFoldersWithoutRightsAndWhatIsNotThere) {
  const test::TemporaryFolder folder;
  folder.write("top/shut/file", "");
  folder.write("file", "");
  std::filesystem::permissions(folder.path() / "top/shut", std::filesystem::perms::none);
  std::filesystem::permissions(folder.path() / "top", std::filesystem::perms::none);
  for (const char* name : {"top", "file", "nothing"}) EXPECT_TRUE(remove_tree(folder.path() / name)) << name;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace ream
