#include "sim/loop_guard.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <semaphore>

#include "sim/haptic_loop.hpp"
#include "support/small_run.hpp"
#include "support/still_device.hpp"

namespace ream::test {
namespace {

using namespace std::chrono_literals;

/// A hand whose driver, against its word, waits in read() from some tick on until it is let go.
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

void wait_until(const std::function<bool()>& done) {
  const auto deadline = std::chrono::steady_clock::now() + 60s;
  while (!done() && std::chrono::steady_clock::now() < deadline) std::this_thread::sleep_for(1ms);
  ASSERT_TRUE(done());
}

TEST(LoopGuard, TakesTheForceFromALoopThatIsStuckInItsDriver) {
  SmallRun run = small_run();
  StuckDevice device(device::make_scripted_device(steady_push(52.0, 10.0), run.model.world_from_plan), 300);
  SpscRing<record::TickReport> reports(16384);
  sim::HapticLoop loop(run.model, run.state, device, reports, {true, sim::Realtime::off});
  loop.start();
  wait_until([&] { return device.taken_away > 0; });
  // A machine that is busy elsewhere may stop the loop before its driver does; that ends it as well.
  wait_until([&] { return device.is_stuck || loop.ended(); });
  wait_until([&] { return loop.stood_still_ms() > sim::LoopGuard::held_limit.count(); });
  loop.stop();  // does not wait for a driver that does not come back
  if (device.is_stuck) {
    EXPECT_FALSE(loop.ended());
    device.let_go.release();
    wait_until([&] { return loop.ended(); });
  }
  EXPECT_EQ(loop.health().end, sim::LoopEnd::stood_still);
  EXPECT_EQ(device.taken_away, 1);
  EXPECT_EQ(device.last_force_n, 0.0);
  EXPECT_FALSE(to_words(sim::LoopEnd::stood_still).empty());
}

struct CountingDevice final : StillDevice {
  void take_force_away() noexcept override { ++taken_away; }
  std::atomic<int> taken_away{0};
};

TEST(LoopGuard, WatchesFromTheFirstBeatToTheEnd) {
  CountingDevice device;
  sim::LoopGuard guard(device, 20ms, false);
  std::this_thread::sleep_for(60ms);
  EXPECT_EQ(device.taken_away, 0) << "nothing has begun";
  EXPECT_TRUE(guard.beat());
  guard.end();
  std::this_thread::sleep_for(60ms);
  EXPECT_EQ(device.taken_away, 0) << "it has ended in order";
}

TEST(LoopGuard, ADeadLoopLosesItsForceOnceAndForGood) {
  CountingDevice device;
  sim::LoopGuard guard(device, 20ms, false);
  guard.beat();
  wait_until([&] { return guard.stood_still_ms() > 40; });
  EXPECT_EQ(device.taken_away, 1);
  EXPECT_FALSE(guard.beat()) << "it must end";
  std::this_thread::sleep_for(20ms);
  const int64_t still_ms = guard.stood_still_ms();
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(guard.stood_still_ms(), still_ms) << "and is not counted any further";
  EXPECT_EQ(device.taken_away, 1);
}

TEST(LoopGuard, ADeviceThatIsClosedMayTakeItsTime) {
  CountingDevice device;
  sim::LoopGuard guard(device, 20ms, false);
  guard.beat();
  guard.closing(std::chrono::hours(1));
  // A machine that stands still may have lost its force before.
  const int before = device.taken_away;
  std::this_thread::sleep_for(60ms);
  EXPECT_EQ(device.taken_away, before);
  sim::LoopGuard shorter(device, 20ms, false);
  shorter.beat();
  shorter.closing(20ms);
  wait_until([&] { return device.taken_away > before; });
  EXPECT_GT(shorter.stood_still_ms(), 20);
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
