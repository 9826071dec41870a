#include "device/crash_guard.hpp"
#include "support/places.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include <thread>

#include "core/file.hpp"
#include "support/child_process.hpp"
#include "support/still_device.hpp"
#include "support/temporary_folder.hpp"

namespace ream::test {
namespace {

/// Runs the endangered program of this build.
class CrashGuard : public testing::Test {
 protected:
  std::unique_ptr<ChildProcess> start(const std::string& how) {
    ChildProcess::Setting setting;
    setting.command = {build_folder() + "/endangered_program", how};
    setting.environment = {{"TMPDIR", folder_.path().string()}, {"HOME", folder_.path().string()}};
    setting.folder = folder_.path();
    setting.out = folder_.path() / "out";
    setting.error = folder_.path() / "error";
    return std::make_unique<ChildProcess>(setting);
  }
  std::string told() const {
    return std::filesystem::exists(folder_.path() / "out") ? read_text_file(folder_.path() / "out") : "";
  }

  TemporaryFolder folder_;
};

class Crash : public CrashGuard, public testing::WithParamInterface<std::pair<const char*, int>> {};

/// Whatever the crash, the device's force is gone before the process is, which ends as it would have.
TEST_P(Crash, LeavesNoForce) {
  const auto [how, signal] = GetParam();
  EXPECT_EQ(start(how)->wait(std::chrono::seconds(120)), 128 + signal)
      << read_text_file(folder_.path() / "error");
  EXPECT_NE(told().find("\nforce\n"), std::string::npos) << "there was a force before";
  EXPECT_TRUE(told().ends_with("taken away\n"))
      << told().substr(told().size() - std::min<size_t>(60, told().size()));
}

INSTANTIATE_TEST_SUITE_P(Every, Crash,
                         testing::Values(std::pair{"segv", SIGSEGV}, std::pair{"abort", SIGABRT},
                                         std::pair{"fpe", SIGFPE}, std::pair{"ill", SIGILL},
                                         std::pair{"bus", SIGBUS}, std::pair{"throw", SIGABRT}),
                         [](const auto& crash) { return std::string(crash.param.first); });

/// The proof that it is the guard that does it.
TEST_F(CrashGuard, WithoutItTheForceStays) {
  EXPECT_EQ(start("unwatched")->wait(std::chrono::seconds(120)), 128 + SIGSEGV);
  EXPECT_EQ(told().find("taken away"), std::string::npos);
}

TEST_F(CrashGuard, ASignalToEndLeavesNoForceAndTheDeviceClosed) {
  for (const int signal : {SIGTERM, SIGINT}) {
    std::filesystem::remove(folder_.path() / "out");
    const auto program = start("signal");
    for (int i = 0; i < 6000 && !program->ended() && told().find("\nforce\n") == std::string::npos; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    program->send_signal(signal);
    EXPECT_EQ(program->wait(std::chrono::seconds(60)), 1);
    EXPECT_TRUE(told().ends_with("no force\nclosed\n"));
    EXPECT_NE(read_text_file(folder_.path() / "error").find("interrupted"), std::string::npos);
  }
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

}  // namespace
}  // namespace ream::test
