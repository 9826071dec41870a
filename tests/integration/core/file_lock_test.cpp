#include "core/file_lock.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

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

/// The system may put somebody aside while they look whether it is held.
TEST_F(FileLockTest, WhoLooksAWhileDoesNotRefuseIt) {
  ASSERT_TRUE(FileLock::attempt(path));
  const FileDescriptor looking(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  ASSERT_EQ(::flock(looking.get(), LOCK_SH | LOCK_NB), 0);
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ::flock(looking.get(), LOCK_UN);
  });
  EXPECT_TRUE(FileLock::attempt(path));
  other.join();
}

TEST_F(FileLockTest, WhoLooksAgainAndAgainDoesNotRefuseIt) {
  ASSERT_TRUE(FileLock::attempt(path));
  std::atomic<bool> done{false};
  std::thread looks([&] {
    while (!done) FileLock::held(path);
  });
  int refused = 0;
  for (int i = 0; i < 2000; ++i) refused += !FileLock::attempt(path);
  done = true;
  looks.join();
  EXPECT_EQ(refused, 0);
}

TEST_F(FileLockTest, WhatIsMovedAwayMeanwhileIsNotHeld) {
  auto first = FileLock::attempt(path);
  ASSERT_TRUE(first);
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    std::filesystem::rename(path, folder.path() / "elsewhere");
    first.reset();
  });
  EXPECT_FALSE(FileLock::attempt(path));
  other.join();
}

TEST_F(FileLockTest, NoPlaceForItIsAnError) {
  test::expect_error(ErrorKind::io, "nowhere/lock",
                     [&] { FileLock::attempt(folder.path() / "nowhere/lock"); });
}

}  // namespace
}  // namespace ream
