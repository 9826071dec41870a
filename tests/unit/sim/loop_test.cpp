#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <sstream>

#include "core/file.hpp"
#include "sim/haptic_loop.hpp"
#include "support/expect_error.hpp"
#include "support/small_run.hpp"
#include "support/temporary_folder.hpp"

namespace ream::test {
namespace {

/// Wraps a device: remembers what was written last and can be made to misbehave at a tick.
class WatchedDevice final : public device::HapticDevice {
 public:
  explicit WatchedDevice(std::unique_ptr<device::HapticDevice> inner) : inner_(std::move(inner)) {}
  const device::DeviceTraits& traits() const noexcept override {
    return own_traits ? *own_traits : inner_->traits();
  }
  void open() override {
    inner_->open();
    is_open = true;
  }
  void close() noexcept override {
    inner_->close();
    is_open = false;
  }
  device::DeviceStatus read(device::DeviceInput& input) noexcept override {
    if (on_read) on_read(reads);
    if (reads++ == fault_at) return device::DeviceStatus::fault;
    if (reads == slow_at) std::this_thread::sleep_for(std::chrono::milliseconds(60));
    const auto status = inner_->read(input);
    if (reads == nan_at)
      input.world_from_handle.translation_mm.x() = std::numeric_limits<double>::quiet_NaN();
    return status;
  }
  void session_paused(bool paused) noexcept override { inner_->session_paused(paused); }
  device::DeviceStatus write(const device::DeviceOutput& output) noexcept override {
    last = output;
    largest_force_n = std::max(largest_force_n, output.force_n.norm());
    return inner_->write(output);
  }
  void take_force_away() noexcept override { inner_->take_force_away(); }
  double closing_ms() const noexcept override { return inner_->closing_ms(); }
  void use_priority(int fifo) noexcept override { inner_->use_priority(fifo); }

  int fault_at = -1, nan_at = -1, slow_at = -1, reads = 0;
  std::function<void(int)> on_read;                ///< told how many reads there have been
  std::optional<device::DeviceTraits> own_traits;  ///< in place of the wrapped one's
  bool is_open = false;
  device::DeviceOutput last;
  double largest_force_n = 0.0;

 private:
  std::unique_ptr<device::HapticDevice> inner_;
};

struct LoopRun {
  LoopRun()
      : run(make()),
        device(device::make_scripted_device(script(), run.model.world_from_plan)),
        reports(4096) {}

  static device::Script script() { return steady_push(52.0, 1.0); }
  static SmallRun make() {
    voxel::BoneModel bone = slab({64, 64, 64}, 0.2, 9.0, 0.5);
    const case_::Plan plan = slab_plan(bone, 9.0);
    return SmallRun(std::move(bone), plan, "sphere 8,4", script());
  }
  sim::LoopEnd go(bool wall_clock = false) {
    sim::HapticLoop loop(run.model, run.state, device, reports, {wall_clock, sim::Realtime::off});
    return loop.run();
  }

  SmallRun run;
  WatchedDevice device;
  SpscRing<record::TickReport> reports;
};

// The force that such a device has dropped may not come back at once. (On a busy machine there are more such
// moments than the one that is asked for.)
TEST(HapticLoop, ForceRisesAnewAfterADeviceLetGoByItself) {
  LoopRun r;
  r.device.own_traits = r.device.traits();
  r.device.own_traits->simulated = false;
  r.device.own_traits->force_expires_ms = 20.0;
  r.device.slow_at = 600;
  EXPECT_EQ(r.go(true), sim::LoopEnd::finished);
  record::TickReport report;
  bool rested = false, pressed_before = false;
  while (r.reports.try_pop(report)) {
    pressed_before |= report.tick < 590 && report.thrust_n > 20.0;
    if (report.tick != 599 && report.tick != 600) continue;
    rested |= report.paused && report.hand_force_n.norm() == 0.0;
  }
  EXPECT_TRUE(pressed_before);
  EXPECT_TRUE(rested);
}

TEST(HapticLoop, RunsAScriptToItsEndAndLeavesNoForce) {
  LoopRun r;
  EXPECT_EQ(r.go(), sim::LoopEnd::finished);
  EXPECT_EQ(r.reports.size(), 1000u);
  EXPECT_GT(r.device.largest_force_n, 20.0);
  EXPECT_EQ(r.device.last.force_n.norm(), 0.0);
  EXPECT_FALSE(r.device.is_open);
}

TEST(HapticLoop, AFaultyDeviceGetsZeroForceAndTheBlackBoxKnowsThePast) {
  LoopRun r;
  r.device.fault_at = 500;
  sim::HapticLoop loop(r.run.model, r.run.state, r.device, r.reports, {false, sim::Realtime::off});
  EXPECT_EQ(loop.run(), sim::LoopEnd::device_fault);
  EXPECT_GT(r.device.largest_force_n, 20.0);
  EXPECT_EQ(r.device.last.force_n.norm(), 0.0);
  EXPECT_EQ(loop.black_box().size(), 500u);
  EXPECT_FALSE(message_of(sim::LoopEnd::device_fault).empty());
}

TEST(HapticLoop, APoseThatIsNotANumberEndsTheSessionWithoutForce) {
  LoopRun r;
  r.device.nan_at = 400;
  EXPECT_EQ(r.go(), sim::LoopEnd::not_finite);
  EXPECT_EQ(r.device.last.force_n.norm(), 0.0);
}

TEST(HapticLoop, EveryTickIsTimedAndSoAreItsParts) {
  LoopRun r;
  sim::HapticLoop loop(r.run.model, r.run.state, r.device, r.reports, {false, sim::Realtime::off});
  loop.run();
  const sim::LoopHealth health = loop.health();
  EXPECT_EQ(health.tick, 1000u);
  EXPECT_EQ(health.missed, 0u) << "virtual time is never late";
  for (const TimingSummary* times :
       {&health.tick_us, &health.lateness_us, &health.read_us, &health.step_us, &health.write_us})
    EXPECT_EQ(times->count, 1000u);
  EXPECT_NEAR(health.tick_us.mean_us,
              health.read_us.mean_us + health.step_us.mean_us + health.write_us.mean_us, 1e-6);
  EXPECT_GT(health.step_us.mean_us, 0.0);
}

TEST(HapticLoop, AllRealTimeIsThereOrTheLoopDoesNotStart) {
  constexpr int no_such_cpu = 1 << 20;
  LoopRun r;
  sim::HapticLoop loop(r.run.model, r.run.state, r.device, r.reports,
                       {true, sim::Realtime::require, no_such_cpu});
  expect_error(ErrorKind::unavailable, "CPU " + std::to_string(no_such_cpu), [&] { loop.start(); });
  EXPECT_FALSE(r.device.is_open);
  EXPECT_EQ(r.device.reads, 0);
}

TEST(HapticLoop, TheBlackBoxTellsTheLastTicksOldestFirst) {
  LoopRun r;
  r.device.fault_at = 700;
  sim::HapticLoop loop(r.run.model, r.run.state, r.device, r.reports, {false, sim::Realtime::off});
  loop.run();
  const TemporaryFolder folder;
  loop.black_box().write(folder.path() / "black-box.csv");
  std::istringstream lines(read_text_file(folder.path() / "black-box.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_TRUE(line.starts_with("tick,lateness_us,read_us,step_us,write_us,")) << line;
  const auto columns = std::count(line.begin(), line.end(), ',');
  for (int tick = 0; std::getline(lines, line); ++tick) {
    EXPECT_TRUE(line.starts_with(std::to_string(tick) + ",0,")) << line;
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), columns);
  }
  EXPECT_EQ(loop.black_box().size(), 700u);
}

TEST(HapticLoop, StopEndsAWallClockLoopWithoutForce) {
  LoopRun r;
  sim::HapticLoop loop(r.run.model, r.run.state, r.device, r.reports, {true, sim::Realtime::off});
  loop.start();
  while (r.reports.size() < 200) std::this_thread::yield();
  loop.stop();
  EXPECT_TRUE(loop.ended());
  EXPECT_EQ(loop.health().end, sim::LoopEnd::stopped);
  EXPECT_EQ(r.device.last.force_n.norm(), 0.0);
}

TEST(HapticLoop, AFullRecordingRingIsAFaultNotALoss) {
  LoopRun r;
  SpscRing<record::TickReport> tiny(64);
  sim::HapticLoop loop(r.run.model, r.run.state, r.device, tiny, {true, sim::Realtime::off});
  EXPECT_EQ(loop.run(), sim::LoopEnd::followers_late);
  EXPECT_EQ(tiny.size(), 64u);
  EXPECT_EQ(r.device.last.force_n.norm(), 0.0);
}

TEST(HapticLoop, APauseFromOutsideIsThatOfTheButtonAndTheScriptWaits) {
  LoopRun r;
  sim::HapticLoop loop(r.run.model, r.run.state, r.device, r.reports, {false, sim::Realtime::off});
  r.device.on_read = [&](int reads) {
    if (reads == 500) loop.pause(true);  // from the next tick on
    if (reads == 700) loop.pause(false);
  };
  EXPECT_EQ(loop.run(), sim::LoopEnd::finished);
  record::TickReport report;
  uint32_t ticks = 0, held = 0;
  double removed_in_pause = 0.0, removed_after = 0.0;
  while (r.reports.try_pop(report)) {
    ++ticks;
    EXPECT_EQ(report.held, report.tick > 500 && report.tick <= 700) << report.tick;
    EXPECT_EQ(report.paused, report.held);
    const auto removed = static_cast<double>(report.coverage_removed[0] + report.coverage_removed[1]);
    if (report.tick > 720) removed_after += removed;
    if (!report.held) continue;
    ++held;
    removed_in_pause += removed;
    EXPECT_EQ(report.hand_force_n.norm(), 0.0) << report.tick;
  }
  EXPECT_EQ(ticks, 1200u);
  EXPECT_EQ(held, 200u);
  EXPECT_EQ(removed_in_pause, 0.0);
  EXPECT_GT(removed_after, 0.0);
}

}  // namespace
}  // namespace ream::test
