#include "sim/watchdogs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/haptic_loop.hpp"
#include "support/small_run.hpp"

namespace ream::test {
namespace {

using device::LinkState;
constexpr double never_ms = std::numeric_limits<double>::infinity();

TEST(PoseWatchdog, KnowsFourStatesByAge) {
  const device::StaleLimits limits{5.0, 10.0, 50.0};
  const std::vector<std::pair<double, LinkState>> table{
      {0.0, LinkState::fresh}, {4.999, LinkState::fresh},   {5.0, LinkState::held},
      {9.9, LinkState::held},  {10.0, LinkState::fading},   {49.0, LinkState::fading},
      {50.0, LinkState::lost}, {never_ms, LinkState::lost}, {std::nan(""), LinkState::lost}};
  for (const auto& [age_ms, state] : table) EXPECT_EQ(sim::link_state(age_ms, limits), state) << age_ms;
}

TEST(PoseWatchdog, MarksWhatIsTooOldAndCountsLosses) {
  sim::PoseWatchdog watchdog({5.0, 10.0, 50.0});
  const auto judge = [&](uint32_t tick, double age_ms) {
    device::DeviceInput input;
    input.age_ms = age_ms;
    input.hand_force_n = Vec3(1, 2, 3);
    watchdog.judge(tick, input);
    return input;
  };
  EXPECT_TRUE(judge(0, never_ms).paused);
  EXPECT_EQ(watchdog.losses(), 0u) << "what has never been there is not lost";
  EXPECT_FALSE(judge(1, 0.0).stale);
  EXPECT_FALSE(judge(2, 8.0).stale);
  const device::DeviceInput fading = judge(3, 12.0);
  EXPECT_TRUE(fading.stale);
  EXPECT_FALSE(fading.paused);
  EXPECT_EQ(fading.hand_force_n, Vec3(Vec3::Zero())) << "a hand that says nothing does not pull";
  EXPECT_TRUE(judge(4, 60.0).paused);
  EXPECT_TRUE(judge(5, 61.0).stale);
  EXPECT_EQ(watchdog.losses(), 1u);
  EXPECT_EQ(watchdog.lost_tick(), 4);
  EXPECT_EQ(judge(6, 0.0).hand_force_n, Vec3(1, 2, 3));
  judge(7, never_ms);
  EXPECT_EQ(watchdog.losses(), 2u);
  EXPECT_EQ(watchdog.lost_tick(), 7);
}

TEST(PoseWatchdog, WhatWasLostIsBackWithAPoseThatIsGoodAndNotBefore) {
  sim::PoseWatchdog watchdog({5.0, 10.0, 50.0});
  const auto judge = [&](uint32_t tick, double age_ms) {
    device::DeviceInput input;
    input.age_ms = age_ms;
    watchdog.judge(tick, input);
    return input;
  };
  EXPECT_TRUE(judge(0, 12.0).paused) << "it has never been there";
  EXPECT_EQ(watchdog.state(), LinkState::lost);
  EXPECT_FALSE(judge(1, 8.0).paused);
  EXPECT_FALSE(judge(2, 12.0).paused);
  EXPECT_TRUE(judge(3, 60.0).paused);
  EXPECT_TRUE(judge(4, 12.0).paused) << "a force would be there at once, and fade";
  EXPECT_EQ(watchdog.state(), LinkState::lost);
  EXPECT_EQ(watchdog.losses(), 1u);
  EXPECT_FALSE(judge(5, 0.0).paused);
  EXPECT_EQ(watchdog.state(), LinkState::fresh);
}

/// A hand that leans on bone, behind a link that says nothing for a while: the pose of its last word.
class SilentDevice final : public device::HapticDevice {
 public:
  SilentDevice(std::unique_ptr<device::HapticDevice> inner, int from, int until)
      : inner_(std::move(inner)), from_(from), until_(until) {}
  const device::DeviceTraits& traits() const noexcept override { return inner_->traits(); }
  void open() override { inner_->open(); }
  void close() noexcept override { inner_->close(); }
  device::DeviceStatus read(device::DeviceInput& input) noexcept override {
    const int tick = tick_++;
    if (tick >= from_ && tick < until_) {
      input = last_;
      input.age_ms = tick - from_ + 1;
      return device::DeviceStatus::ok;
    }
    const device::DeviceStatus status = inner_->read(last_);
    input = last_;
    return status;
  }
  device::DeviceStatus write(const device::DeviceOutput& output) noexcept override {
    force_n.push_back(output.force_n.norm());
    return inner_->write(output);
  }
  void session_paused(bool paused) noexcept override { inner_->session_paused(paused); }
  void take_force_away() noexcept override { inner_->take_force_away(); }
  double closing_ms() const noexcept override { return inner_->closing_ms(); }
  void use_priority(int fifo) noexcept override { inner_->use_priority(fifo); }
  std::vector<double> force_n;

 private:
  std::unique_ptr<device::HapticDevice> inner_;
  int from_, until_, tick_ = 0;
  device::DeviceInput last_;
};

struct SilentRun {
  static constexpr int from = 600;
  static constexpr double force_max_n = 60.0;
  explicit SilentRun(int silent_ticks) : run(make()) {
    run.state.output = sim::HandOutput(0.1);
    run.model.settings.limits.force_max_n = force_max_n;
    SilentDevice device(device::make_scripted_device(script(), run.model.world_from_plan), from,
                        from + silent_ticks);
    SpscRing<record::TickReport> ring(4096);
    sim::HapticLoop loop(run.model, run.state, device, ring, {false, sim::Realtime::off});
    EXPECT_EQ(loop.run(), sim::LoopEnd::finished);
    health = loop.health();
    force_n = device.force_n;
    record::TickReport report;
    while (ring.try_pop(report)) reports.push_back(report);
  }
  static device::Script script() { return steady_push(52.0, 1.5); }
  static SmallRun make() {
    voxel::BoneModel bone = slab({64, 64, 64}, 0.2, 9.0, 0.5);
    const case_::Plan plan = slab_plan(bone, 9.0);
    return SmallRun(std::move(bone), plan, "sphere 8,4", script());
  }
  SmallRun run;
  sim::LoopHealth health;
  std::vector<double> force_n;
  std::vector<record::TickReport> reports;
};

TEST(StalePoses, AShortSilenceChangesNothing) {
  const SilentRun silent(8), whole(0);
  EXPECT_EQ(silent.health.losses, 0u);
  for (const record::TickReport& report : silent.reports) ASSERT_FALSE(report.stale);
  for (size_t i = SilentRun::from; i < SilentRun::from + 50; ++i) EXPECT_GT(silent.force_n[i], 10.0) << i;
  EXPECT_GT(whole.force_n[SilentRun::from], 10.0);
}

TEST(StalePoses, FromTenMillisecondsOnTheForceFallsToNothingInTwentyAndComesBackByTheRamp) {
  const SilentRun r(30);
  const size_t fading = SilentRun::from + 9;  // age 10 ms
  const double before_n = r.force_n[fading - 1];
  ASSERT_GT(before_n, 10.0);
  EXPECT_FALSE(r.reports[fading - 1].stale);
  for (size_t i = 0; i < 20; ++i) {
    EXPECT_TRUE(r.reports[fading + i].stale);
    EXPECT_FALSE(r.reports[fading + i].paused);
    EXPECT_LE(r.force_n[fading + i], before_n * (1.0 - static_cast<double>(i + 1) / 20.0) * 1.02) << i;
    if (i < 18) {
      EXPECT_GT(r.force_n[fading + i], 0.0) << "no step, tick " << i;
    }
  }
  EXPECT_EQ(r.force_n[fading + 19], 0.0) << "nothing at all 30 ms after the last word";
  const size_t back = SilentRun::from + 30;
  EXPECT_FALSE(r.reports[back].stale);
  for (size_t i = back + 1; i < r.force_n.size(); ++i)
    EXPECT_LE(r.force_n[i] - r.force_n[i - 1], SilentRun::force_max_n / 100.0 + 1e-9) << "tick " << i;
  EXPECT_EQ(r.health.losses, 0u);
}

TEST(StalePoses, ALostDeviceRestsTheSessionWithoutForceAndWithoutTakingBone) {
  const SilentRun r(300);
  const size_t lost = SilentRun::from + 49;  // age 50 ms
  for (size_t i = lost; i < SilentRun::from + 300; ++i) {
    EXPECT_TRUE(r.reports[i].paused);
    EXPECT_EQ(r.reports[i].link, LinkState::lost);
    EXPECT_EQ(r.force_n[i], 0.0);
    EXPECT_EQ(r.reports[i].changed_bricks, 0u);
    EXPECT_EQ(r.reports[i].world_from_tool.translation_mm, r.reports[lost].world_from_tool.translation_mm);
  }
  EXPECT_FALSE(r.reports[SilentRun::from + 300].paused) << "goes on";
  EXPECT_EQ(r.health.losses, 1u);
  EXPECT_EQ(r.health.lost_tick, static_cast<int64_t>(lost));
  EXPECT_EQ(r.health.link, LinkState::fresh);
}

TEST(StalePoses, FadingOnceBegunGoesOnToTheEnd) {
  sim::HandOutput output(0.0);
  EXPECT_EQ(output.fade(false, false), 1.0);
  double before = output.fade(true, false);
  EXPECT_DOUBLE_EQ(before, 0.95);
  for (int i = 0; i < 18; ++i) {
    const double now = output.fade(false, false);
    EXPECT_NEAR(before - now, 0.05, 1e-12);
    before = now;
  }
  EXPECT_EQ(output.fade(false, false), 0.0);
  EXPECT_EQ(output.fade(false, false), 1.0) << "and the start-up ramp goes on from here";
}

}  // namespace
}  // namespace ream::test
