#include "core/signal_handlers.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <string>

namespace ream {
namespace {

stack_t stack_of_this_thread() {
  stack_t now{};
  ::sigaltstack(nullptr, &now);
  return now;
}

TEST(SignalStack, EveryThreadOfOursHasOneWithAPageBeneathThatNobodyMayTouch) {
  const stack_t mine = stack_of_this_thread();
  std::string line;
  start_thread([&line] {
    const stack_t now = stack_of_this_thread();
    ASSERT_EQ(now.ss_flags & SS_DISABLE, 0);
    EXPECT_GE(now.ss_size, 64u * 1024u);
    char first[32];
    std::snprintf(first, sizeof first, "%lx-", reinterpret_cast<unsigned long>(now.ss_sp));
    std::ifstream maps("/proc/self/maps");
    for (std::string before; std::getline(maps, line) && !line.starts_with(first); before = line)
      if (line.find(std::string("-") + std::string(first, std::strlen(first) - 1) + " ---p") !=
          std::string::npos)
        return;
    line.clear();
  }).join();
  EXPECT_NE(line, "") << "no page without access ends where the stack begins";
  EXPECT_EQ(stack_of_this_thread().ss_sp, mine.ss_sp);
}

TEST(SignalStack, GivesBackTheOneThatWasThere) {
  start_thread([] {
    const stack_t outer = stack_of_this_thread();
    {
      const SignalStack inner;
      EXPECT_NE(stack_of_this_thread().ss_sp, outer.ss_sp);
    }
    EXPECT_EQ(stack_of_this_thread().ss_sp, outer.ss_sp);
    EXPECT_EQ(stack_of_this_thread().ss_size, outer.ss_size);
  }).join();
}

TEST(SignalHandlers, AreBackWhenSomebodyElseHasPutHisThere) {
  static volatile sig_atomic_t seen = 0;
  keep_handler(SIGUSR2, [](int) { seen = seen + 1; });
  for (const int flags : {0, static_cast<int>(SA_RESETHAND)}) {
    struct sigaction other {};
    other.sa_handler = SIG_IGN;
    other.sa_flags = flags;
    ::sigaction(SIGUSR2, &other, nullptr);
    seen = 0;
    ::raise(SIGUSR2);
    EXPECT_EQ(seen, 0);
    EXPECT_TRUE(restore_handlers());
    for (int i = 1; i <= 2; ++i) {
      ::raise(SIGUSR2);
      EXPECT_EQ(seen, i) << "and it stays";
    }
  }
}

/// SIGKILL's can be nobody's.
TEST(SignalHandlers, SayWhenTheyCannotHold) {
  const pid_t child = ::fork();
  if (child == 0) {
    keep_handler(SIGKILL, [](int) {});
    ::_exit(restore_handlers() ? 1 : 0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace ream
