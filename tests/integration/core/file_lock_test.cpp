#include "core/file_lock.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream {
namespace {

class FileLockTest : public testing::Test {
 protected:
  test::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "lock";
};

TEST_F(FileLockTest, OnlyOneHoldsItUntilItIsLetGo) {
  EXPECT_FALSE(FileLock::held(path));
  EXPECT_TRUE(folder.entries().empty()) << "asking makes nothing";
  auto first = FileLock::attempt(path);
  ASSERT_TRUE(first);
  EXPECT_TRUE(FileLock::held(path));
  EXPECT_FALSE(FileLock::attempt(path));
  FileLock moved = std::move(*first);
  first.reset();
  EXPECT_TRUE(FileLock::held(path)) << "the lock went along";
  { const FileLock gone = std::move(moved); }
  EXPECT_FALSE(FileLock::held(path));
  EXPECT_TRUE(FileLock::attempt(path));
}

TEST_F(FileLockTest, AKilledProcessLetsGo) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const auto lock = FileLock::attempt(path);
    const char answer = lock ? 'y' : 'n';
    if (::write(ready[1], &answer, 1) != 1) ::_exit(1);
    for (;;) ::pause();
  }
  char answer = '?';
  ASSERT_EQ(::read(ready[0], &answer, 1), 1);
  EXPECT_EQ(answer, 'y');
  EXPECT_FALSE(FileLock::attempt(path));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(FileLock::attempt(path));
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST_F(FileLockTest, NoPlaceForItIsAnError) {
  test::expect_error(ErrorKind::io, "nowhere/lock",
                     [&] { FileLock::attempt(folder.path() / "nowhere/lock"); });
}

}  // namespace
}  // namespace ream
