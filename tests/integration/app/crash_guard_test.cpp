#include "device/crash_guard.hpp"
#include "support/places.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include <atomic>
#include <thread>

#include "core/file.hpp"
#include "core/signal_handlers.hpp"
#include "support/child_process.hpp"
#include "support/full_tests.hpp"
#include "support/still_device.hpp"
#include "support/temporary_folder.hpp"

namespace ream::test {
namespace {

/// Runs the endangered program of this build. Its kernels are compiled anew each time, as nothing is in its
/// home.
class CrashGuard : public testing::Test {
 protected:
  using Words = std::vector<std::string>;

  std::unique_ptr<ChildProcess> start(const Words& how, Words command = {}) {
    command.push_back(build_folder() + "/endangered_program");
    command.insert(command.end(), how.begin(), how.end());
    ChildProcess::Setting setting;
    setting.command = std::move(command);
    const std::string own = folder_.path().string();
    setting.environment = {
        {"TMPDIR", own}, {"HOME", own}, {"PATH", "/usr/bin:/bin"}};  // PoCL asks for a linker
    setting.folder = folder_.path();
    setting.out = folder_.path() / "out";
    setting.error = folder_.path() / "error";
    std::filesystem::remove(setting.out);
    return std::make_unique<ChildProcess>(setting);
  }
  std::string told() const {
    return std::filesystem::exists(folder_.path() / "out") ? read_text_file(folder_.path() / "out") : "";
  }
  std::string last_told() const { return told().substr(told().size() - std::min<size_t>(60, told().size())); }
  std::string error() const { return read_text_file(folder_.path() / "error"); }
  void until_it_pushes(ChildProcess& program, size_t since = 0) const {
    for (int i = 0; i < 12'000 && !program.ended() && told().find("\nforce\n", since) == std::string::npos;
         ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  void expect_no_force_after(const Words& how, int exit_code) {
    SCOPED_TRACE(how[0] + (how.size() > 1 ? " in " + how[1] + ", " + how[2] : ""));
    EXPECT_EQ(start(how)->wait(std::chrono::seconds(120)), exit_code) << error();
    EXPECT_NE(told().find("\nforce\n"), std::string::npos) << "there was a force before";
    EXPECT_TRUE(told().ends_with("taken away\n")) << last_told();
  }

  TemporaryFolder folder_;
};

class Crash : public CrashGuard, public testing::WithParamInterface<std::pair<const char*, int>> {};

/// Whatever the crash, the device's force is gone before the process is, which ends as it would have.
TEST_P(Crash, LeavesNoForce) {
  const auto [how, signal] = GetParam();
  expect_no_force_after({how, "loop", "cpu"}, 128 + signal);
}

/// In full tests every way, else those that differ most.
std::vector<std::pair<const char*, int>> crashes() {
  std::vector<std::pair<const char*, int>> ways{
      {"segv", SIGSEGV}, {"throw", SIGABRT}, {"recursion", SIGSEGV}, {"fpe", SIGFPE}};
  if (full_tests())
    ways.insert(ways.end(), {{"abort", SIGABRT},
                             {"ill", SIGILL},
                             {"bus", SIGBUS},
                             {"trap", SIGTRAP},
                             {"sys", SIGSYS},
                             {"xcpu", SIGXCPU}});
  return ways;
}

INSTANTIATE_TEST_SUITE_P(Every, Crash, testing::ValuesIn(crashes()),
                         [](const auto& crash) { return std::string(crash.param.first); });

#if !defined(__SANITIZE_ADDRESS__)  // which ends the process itself, and in its own way
TEST_F(CrashGuard, ACorruptHeapLeavesNoForce) {
  expect_no_force_after({"heap", "loop", "cpu"}, 128 + SIGABRT);
  expect_no_force_after({"heap", "main", "opencl"}, 128 + SIGABRT);
}
#endif

class CrashAfterKernels : public Crash {};

/// PoCL and the compiler in it have handlers of their own, from when the first kernel is built.
TEST_P(CrashAfterKernels, LeavesNoForce) {
  const auto [how, signal] = GetParam();
  for (const char* where : {"main", "thread"}) expect_no_force_after({how, where, "opencl"}, 128 + signal);
}

INSTANTIATE_TEST_SUITE_P(Every, CrashAfterKernels,
                         testing::Values(std::pair{"abort", SIGABRT}, std::pair{"throw", SIGABRT},
                                         std::pair{"fpe", SIGFPE}, std::pair{"recursion", SIGSEGV}),
                         [](const auto& crash) { return std::string(crash.param.first); });

#if defined(__SANITIZE_ADDRESS__)
constexpr int unwatched_crash = 1;  // as the sanitizer ends a process
#else
constexpr int unwatched_crash = 128 + SIGSEGV;
#endif

/// The proof that it is the guard that does it.
TEST_F(CrashGuard, WithoutItTheForceStays) {
  EXPECT_EQ(start({"unwatched"})->wait(std::chrono::seconds(120)), unwatched_crash);
  EXPECT_EQ(told().find("taken away"), std::string::npos);
}

TEST_F(CrashGuard, ASignalToEndLeavesNoForceAndTheDeviceClosed) {
  for (const auto& [signal, backend] : {std::pair{SIGTERM, "cpu"},
                                        {SIGINT, "cpu"},
                                        {SIGHUP, "opencl"},
                                        {SIGQUIT, "opencl"},
                                        {SIGUSR1, "cpu"},
                                        {SIGUSR2, "opencl"},
                                        {SIGVTALRM, "cpu"},
                                        {SIGPROF, "cpu"},
                                        {SIGIO, "cpu"},
                                        {SIGPWR, "cpu"},
                                        {SIGSTKFLT, "cpu"},
                                        {SIGRTMIN, "cpu"},
                                        {SIGRTMAX, "opencl"},
                                        {SIGTERM, "opencl"}}) {
    SCOPED_TRACE(std::to_string(signal) + ", " + backend);
    const auto program = start({"signal", "loop", backend});
    until_it_pushes(*program);
    program->send_signal(signal);
    EXPECT_EQ(program->wait(std::chrono::seconds(60)), 1);
    EXPECT_TRUE(told().ends_with("no force\nclosed\n")) << last_told();
    EXPECT_NE(error().find("interrupted"), std::string::npos);
  }
}

TEST_F(CrashGuard, AClosedTerminalAndAReaderThatHasGoneEndNothingThatIsToGoOn) {
  const auto program = start({"signal", "loop", "opencl"}, {"/usr/bin/nohup"});
  until_it_pushes(*program);
  for (const int signal : {SIGHUP, SIGPIPE}) {
    const size_t before = told().size();
    program->send_signal(signal);
    until_it_pushes(*program, before);
    EXPECT_FALSE(program->ended()) << signal;
  }
  program->send_signal(SIGTERM);
  EXPECT_EQ(program->wait(std::chrono::seconds(60)), 1);
}

TEST_F(CrashGuard, ALoopThatDoesNotComeBackDoesNotKeepTheProcess) {
  expect_no_force_after({"stuck"}, 1);
  EXPECT_NE(error().find("stands still"), std::string::npos) << error();
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "ream-black-box.csv"));
}

TEST_F(CrashGuard, NorDoesAnythingElseOnceItIsToldToEnd) {
  const auto program = start({"stuck", "main", "cpu"});
  until_it_pushes(*program);
  program->send_signal(SIGTERM);
  EXPECT_EQ(program->wait(std::chrono::seconds(120)), 1);
  EXPECT_NE(error().find("told to end"), std::string::npos) << error();
  EXPECT_TRUE(told().ends_with("no force\nclosed\n")) << last_told();
}

TEST(CrashWatch, HasPlacesForSixtyFourAndGivesThemBack) {
  StillDevice device;
  for (int round = 0; round < 3; ++round) {
    std::vector<std::unique_ptr<device::CrashWatch>> watches;
    for (int i = 0; i < 64; ++i) {
      watches.push_back(std::make_unique<device::CrashWatch>(device));
      EXPECT_TRUE(watches.back()->is_watched());
    }
    EXPECT_FALSE(device::CrashWatch(device).is_watched());
  }
}

/// What a library does to them when it is used for the first time.
TEST(CrashWatch, PutsHandlersBackThatALibraryHasReplaced) {
  static std::atomic<int> asked{0};
  keep_handler(SIGUSR1, [](int) { ++asked; });
  StillDevice device;
  for (int round = 1; round <= 3; ++round) {
    ::signal(SIGUSR1, SIG_IGN);
    ::raise(SIGUSR1);
    EXPECT_EQ(asked, round - 1);
    EXPECT_TRUE(device::CrashWatch(device).is_watched());
    ::raise(SIGUSR1);
    EXPECT_EQ(asked, round);
  }
}

}  // namespace
}  // namespace ream::test
