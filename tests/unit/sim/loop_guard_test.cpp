#include "sim/watchdogs.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <semaphore>

#include "sim/haptic_loop.hpp"
#include "support/small_run.hpp"
#include "support/still_device.hpp"
#include "support/wait_until.hpp"

namespace ream::test {
namespace {

using namespace std::chrono_literals;

/// The guard's time goes on only as a test says, so that no machine that is busy elsewhere can trip it.
std::atomic<int64_t> now_ns{1};
std::atomic<int> clock_reads{0};
int64_t test_clock() {
  ++clock_reads;
  return now_ns;
}
void pass(std::chrono::nanoseconds time) { now_ns += time.count(); }
/// The guard has judged the time as it is.
void wait_for_its_look() {
  wait_until("the guard", [before = clock_reads.load()] { return clock_reads >= before + 2; });
}

/// A hand whose ticks take a millisecond each and whose driver, against its word, waits in read() from some
/// tick on until it is let go.
class StuckDevice final : public device::HapticDevice {
 public:
  StuckDevice(std::unique_ptr<device::HapticDevice> inner, int stuck_at)
      : inner_(std::move(inner)), traits_(inner_->traits()), stuck_at_(stuck_at) {
    traits_.simulated = false;
  }
  const device::DeviceTraits& traits() const noexcept override { return traits_; }
  void open() override { inner_->open(); }
  void close() noexcept override { inner_->close(); }
  device::DeviceStatus read(device::DeviceInput& input) noexcept override {
    pass(1ms);
    if (reads_++ == stuck_at_) {
      is_stuck = true;
      let_go.acquire();
    }
    return inner_->read(input);
  }
  device::DeviceStatus write(const device::DeviceOutput& output) noexcept override {
    last_force_n = output.force_n.norm();
    return inner_->write(output);
  }
  void take_force_away() noexcept override { ++taken_away; }
  void session_paused(bool paused) noexcept override { inner_->session_paused(paused); }
  double closing_ms() const noexcept override { return inner_->closing_ms(); }
  void use_priority(int fifo) noexcept override { inner_->use_priority(fifo); }

  std::atomic<bool> is_stuck{false};
  std::atomic<int> taken_away{0};
  std::atomic<double> last_force_n{0.0};
  std::binary_semaphore let_go{0};

 private:
  std::unique_ptr<device::HapticDevice> inner_;
  device::DeviceTraits traits_;
  int stuck_at_, reads_ = 0;
};

SmallRun small_run() {
  voxel::BoneModel bone = slab({64, 64, 64}, 0.2, 9.0, 0.5);
  const case_::Plan plan = slab_plan(bone, 9.0);
  return SmallRun(std::move(bone), plan, "sphere 8,4", steady_push(52.0, 10.0));
}

TEST(LoopGuard, TakesTheForceFromALoopThatIsStuckInItsDriver) {
  SmallRun run = small_run();
  StuckDevice device(device::make_scripted_device(steady_push(52.0, 10.0), run.model.world_from_plan), 300);
  SpscRing<record::TickReport> reports(16384);
  sim::HapticLoop loop(run.model, run.state, device, reports, {true, sim::Realtime::off, -1, test_clock});
  loop.start();
  wait_until("the driver", [&] { return device.is_stuck.load(); });
  pass(sim::LoopGuard::held_limit - 1ms);
  wait_for_its_look();
  EXPECT_EQ(device.taken_away, 0) << "its limit, of which the tick has used a millisecond";
  EXPECT_GT(device.last_force_n, 0.0);
  pass(1ms);
  wait_until("the guard", [&] { return loop.stood_still_ms() > 0; });
  EXPECT_EQ(loop.stood_still_ms(), sim::LoopGuard::held_limit.count() + 1);
  loop.stop();  // does not wait for a driver that does not come back
  EXPECT_FALSE(loop.ended());
  device.let_go.release();
  wait_until("the end", [&] { return loop.ended(); });
  EXPECT_EQ(loop.health().end, sim::LoopEnd::stood_still);
  EXPECT_EQ(device.taken_away, 1);
  EXPECT_EQ(device.last_force_n, 0.0);
  EXPECT_FALSE(message_of(sim::LoopEnd::stood_still).empty());
}

struct CountingDevice final : StillDevice {
  void take_force_away() noexcept override { ++taken_away; }
  std::atomic<int> taken_away{0};
};

TEST(LoopGuard, WatchesFromTheFirstBeatToTheEnd) {
  CountingDevice device;
  sim::LoopGuard guard(device, 20ms, false, test_clock);
  pass(60ms);
  wait_for_its_look();
  EXPECT_EQ(device.taken_away, 0) << "nothing has begun";
  EXPECT_TRUE(guard.beat());
  guard.end();
  pass(60ms);
  wait_for_its_look();
  EXPECT_EQ(device.taken_away, 0) << "it has ended in order";
}

TEST(LoopGuard, ADeadLoopLosesItsForceOnceAndForGood) {
  CountingDevice device;
  sim::LoopGuard guard(device, 20ms, false, test_clock);
  guard.beat();
  pass(21ms);
  wait_until("the guard", [&] { return guard.stood_still_ms() == 21; });
  pass(20ms);
  wait_until("the guard", [&] { return guard.stood_still_ms() == 41; });
  EXPECT_EQ(device.taken_away, 1);
  EXPECT_FALSE(guard.beat()) << "it must end";
  pass(50ms);
  wait_for_its_look();
  EXPECT_EQ(guard.stood_still_ms(), 41) << "and is not counted any further";
  EXPECT_EQ(device.taken_away, 1);
}

TEST(LoopGuard, ADeviceThatIsClosedMayTakeItsTime) {
  CountingDevice device;
  sim::LoopGuard guard(device, 20ms, false, test_clock);
  guard.beat();
  guard.closing(30ms);
  pass(50ms);
  wait_for_its_look();
  EXPECT_EQ(device.taken_away, 0);
  pass(1ms);
  wait_until("the guard", [&] { return guard.stood_still_ms() == 51; });
  EXPECT_EQ(device.taken_away, 1);
}

TEST(LoopGuard, OneThatNobodyHoldsOrThatLetsGoByItselfIsGivenMoreTime) {
  device::DeviceTraits traits;
  EXPECT_EQ(sim::LoopGuard::limit_for(traits), 50ms);
  traits.simulated = true;
  EXPECT_EQ(sim::LoopGuard::limit_for(traits), sim::LoopGuard::harmless_limit);
  traits.simulated = false;
  traits.force_expires_ms = 20.0;
  EXPECT_EQ(sim::LoopGuard::limit_for(traits), sim::LoopGuard::harmless_limit);
}

}  // namespace
}  // namespace ream::test
