#pragma once
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>

#include "device/vendors/servo_device.hpp"

namespace ream::test {

/// A test that ticks a device by hand, without a session.
class TickedDevice : public testing::Test {
 protected:
  /// Before what a test speaks to it with.
  void TearDown() override { device.reset(); }

  /// Ticks with a force of 2 N along z until it is so; a machine that stands still takes it back meanwhile.
  template <typename Condition>
  void until(Condition condition) {
    bool reached = false;
    for (int i = 0; i < 20'000 && !reached; ++i) {
      EXPECT_EQ(device->read(input), device::DeviceStatus::ok);
      device::DeviceOutput output;
      output.force_n = Vec3(0, 0, 2);
      device->write(output);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      reached = condition();
    }
    EXPECT_TRUE(reached);
  }

  std::unique_ptr<device::ServoDevice> device;
  device::DeviceInput input;
};

}  // namespace ream::test
