#include "app/device_trial.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/clock.hpp"

namespace ream::app {
namespace {

/// A handle that somebody lowers by 20 mm in the first second; the test may make it misbehave.
class LoweredDevice final : public device::HapticDevice {
 public:
  using Change = std::function<device::DeviceStatus(int tick, device::DeviceInput&)>;
  explicit LoweredDevice(Change change = {}) : change_(std::move(change)) {
    traits_.force_max_n = 3.3;
    traits_.stiffness_max_n_mm = 0.4;
    traits_.simulated = true;  // the machine that runs the tests may be late
  }
  const device::DeviceTraits& traits() const noexcept override { return traits_; }
  void open() override { is_open = true; }
  void close() noexcept override { is_open = false; }
  device::DeviceStatus read(device::DeviceInput& input) noexcept override {
    const int tick = tick_++;
    const double lowered_mm = tick < 100 ? 0.0 : std::min(20.0, 0.1 * (tick - 100));
    input.world_from_handle.translation_mm = Vec3(0, 0, -lowered_mm);
    input.age_ms = 0.0;
    return change_ ? change_(tick, input) : device::DeviceStatus::ok;
  }
  device::DeviceStatus write(const device::DeviceOutput& output) noexcept override {
    forces_n.push_back(output.force_n);
    return device::DeviceStatus::ok;
  }
  void session_paused(bool) noexcept override {}
  void take_force_away() noexcept override {}
  double closing_ms() const noexcept override { return 0.0; }
  void use_priority(int) noexcept override {}
  bool is_open = false;
  std::vector<Vec3> forces_n;

 private:
  Change change_;
  device::DeviceTraits traits_;
  int tick_ = 0;
};

constexpr TrialTimes short_times{0.05, 0.1, 0.35, 0.1};

DeviceTrial tried(LoweredDevice& device) { return try_out(device, short_times, sim::Realtime::off); }

TEST(DeviceTrial, AGoodDeviceFeelsAGentleWallThatFadesAndIsUsable) {
  LoweredDevice device;
  const DeviceTrial trial = tried(device);
  EXPECT_TRUE(is_usable(trial)) << verdict_words(trial).front();
  EXPECT_EQ(verdict_words(trial).front(), "usable");
  EXPECT_EQ(trial.ticks, 550u);
  EXPECT_NEAR(trial.pose_rate_hz(), 1000.0, 1.0);
  EXPECT_NEAR(trial.moved_mm.z(), 20.0, 1e-9);
  EXPECT_GT(trial.wall_s, 0.2);
  EXPECT_FALSE(device.is_open);
  ASSERT_EQ(device.forces_n.size(), 551u);
  for (size_t tick = 0; tick < device.forces_n.size(); ++tick) {
    EXPECT_LE(device.forces_n[tick].norm(), 0.33 + 1e-12) << "a tenth of what it can";
    EXPECT_GE(device.forces_n[tick].z(), 0.0) << "it holds against the hand";
    if (tick < 200) {
      EXPECT_EQ(device.forces_n[tick].norm(), 0.0) << "free, and then above the wall";
    }
  }
  EXPECT_NEAR(device.forces_n[440].norm(), 0.33, 1e-9);
  EXPECT_NEAR(device.forces_n[500].norm(), 0.165, 0.01) << "halfway down";
  EXPECT_EQ(device.forces_n.back().norm(), 0.0);
}

TEST(DeviceTrial, SaysWhatIsWrong) {
  using device::DeviceStatus;
  const auto never = [](int, device::DeviceInput& input) {
    input.age_ms = std::numeric_limits<double>::infinity();
    return DeviceStatus::ok;
  };
  const auto wild = [](int tick, device::DeviceInput& input) {
    if (tick == 300) input.world_from_handle.translation_mm.x() = std::numeric_limits<double>::quiet_NaN();
    return DeviceStatus::ok;
  };
  const auto faulty = [](int tick, device::DeviceInput&) {
    return tick < 300 ? DeviceStatus::ok : DeviceStatus::fault;
  };
  const auto silent = [](int tick, device::DeviceInput& input) {
    if (tick > 300 && tick < 400) input.age_ms = tick - 300;
    return DeviceStatus::ok;
  };
  const auto slow = [](int tick, device::DeviceInput& input) {
    input.age_ms = tick % 20;
    return DeviceStatus::ok;
  };
  const std::vector<std::pair<LoweredDevice::Change, std::string>> table{{never, "no pose came"},
                                                                         {wild, "not numbers"},
                                                                         {faulty, "reported a fault"},
                                                                         {silent, "stopped answering"},
                                                                         {slow, "older than"}};
  for (const auto& [change, words] : table) {
    SCOPED_TRACE(words);
    LoweredDevice device(change);
    const DeviceTrial trial = tried(device);
    EXPECT_FALSE(is_usable(trial));
    EXPECT_NE(verdict_words(trial).front().find(words), std::string::npos) << verdict_words(trial).front();
    EXPECT_FALSE(to_json(trial).at("usable").get<bool>());
    EXPECT_EQ(device.forces_n.back().norm(), 0.0);
    EXPECT_FALSE(device.is_open);
  }
}

TEST(DeviceTrial, ForceGoesWhenPosesAreTooOld) {
  LoweredDevice device([](int tick, device::DeviceInput& input) {
    if (tick > 400 && tick < 430) input.age_ms = tick - 400;
    return device::DeviceStatus::ok;
  });
  tried(device);
  EXPECT_GT(device.forces_n[405].norm(), 0.0);
  for (size_t tick = 410; tick < 430; ++tick) EXPECT_EQ(device.forces_n[tick].norm(), 0.0) << tick;
}

}  // namespace
}  // namespace ream::app
