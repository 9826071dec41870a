#include "device/network/network_device.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/expect_error.hpp"
#include "support/seed.hpp"

namespace ream::device {
namespace {

int64_t network_now_ns = 0;
int64_t network_clock() { return network_now_ns; }
constexpr int64_t ms = 1'000'000;

class NetworkDeviceTest : public testing::Test {
 protected:
  NetworkDeviceTest() {
    network_now_ns = 1'000 * ms;
    device.open();
  }
  void arrive(double x_mm, uint64_t connection = 1) {
    RemoteInput input;
    input.arrived_ns = network_now_ns;
    input.connection = connection;
    input.place_mm = {x_mm, 0, 0};
    link->input.store(input);
  }
  DeviceInput read() {
    DeviceInput input;
    EXPECT_EQ(device.read(input), DeviceStatus::ok);
    return input;
  }
  double read_x() { return read().world_from_handle.translation_mm.x(); }
  /// Reads at 1 kHz while a hand at 100 mm/s is heard each `period_ms`; largest step in mm.
  double largest_step_mm(double period_ms, double jitter_ms) {
    const uint32_t seed = test::seed(7);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> jitter(-jitter_ms, jitter_ms);
    double next_ms = 0.0, sent = 0.0, before = std::nan(""), largest = 0.0;
    const int64_t start = network_now_ns;
    for (int t = 0; t < 2000; ++t) {
      network_now_ns = start + t * ms;
      while (t >= next_ms) {
        arrive(0.1 * sent * period_ms);
        next_ms = ++sent * period_ms + jitter(random);
      }
      const double x = read_x();
      // Until it knows how often it is told, it has to guess.
      if (t > 500) largest = std::max(largest, std::abs(x - before));
      before = x;
    }
    return largest;
  }

  std::shared_ptr<RemoteLink> link = std::make_shared<RemoteLink>();
  NetworkDevice device{"touch", link, network_clock};
};

TEST_F(NetworkDeviceTest, HasNeverSpokenAtFirst) { EXPECT_TRUE(std::isinf(read().age_ms)); }

TEST_F(NetworkDeviceTest, AConnectionCountsAsABreakAndThenAsItsPose) {
  arrive(5.0);
  EXPECT_TRUE(std::isinf(read().age_ms));
  network_now_ns += ms;
  const DeviceInput input = read();
  EXPECT_DOUBLE_EQ(input.age_ms, 1.0);
  EXPECT_DOUBLE_EQ(input.world_from_handle.translation_mm.x(), 5.0);
  // Another one holds its device elsewhere, and its first message may have been overtaken by its second.
  arrive(80.0, 2);
  arrive(81.0, 2);
  network_now_ns += ms;
  EXPECT_TRUE(std::isinf(read().age_ms));
  EXPECT_DOUBLE_EQ(read_x(), 81.0);
}

TEST_F(NetworkDeviceTest, AgeCountsFromTheArrival) {
  arrive(0.0);
  read();
  for (const double age_ms : {0.0, 4.9, 50.0, 3600.0e3}) {
    network_now_ns = 1'000 * ms + static_cast<int64_t>(age_ms * ms);
    EXPECT_NEAR(read().age_ms, age_ms, 1e-6);
  }
}

TEST_F(NetworkDeviceTest, AfterALongSilenceItIsWhereTheHandIsNow) {
  arrive(0.0);
  read();
  network_now_ns += ms;
  read();
  network_now_ns += 60 * ms;
  arrive(40.0);
  EXPECT_DOUBLE_EQ(read_x(), 40.0);
}

TEST_F(NetworkDeviceTest, AQuickSenderIsDelayedByNoMoreThanOneMessage) {
  double delay_mm = 0.0;
  for (int t = 0; t < 500; ++t) {
    network_now_ns += ms;
    arrive(0.1 * t);
    const double x = read_x();
    if (t > 10) delay_mm = std::max(delay_mm, 0.1 * t - x);
  }
  EXPECT_LE(delay_mm, 0.1 + 1e-9);
  network_now_ns += ms;
  EXPECT_DOUBLE_EQ(read_x(), 0.1 * 499);
}

TEST_F(NetworkDeviceTest, ASlowSenderMakesNoSteps) {
  // At 100 mm/s a tick is 0.1 mm and a message of 60 Hz 1.7 mm.
  EXPECT_LT(largest_step_mm(1000.0 / 60.0, 0.0), 0.13);
}

TEST_F(NetworkDeviceTest, AJitterySenderMakesNoneThatIsALargeShareOfItsMessages) {
  EXPECT_LT(largest_step_mm(8.0, 3.0), 0.3);
}

TEST_F(NetworkDeviceTest, AGlideTurnsToo) {
  arrive(0.0);
  read();
  for (int message = 0; message < 30; ++message) {
    network_now_ns += 10 * ms;
    arrive(0.0);
    read();
  }
  RemoteInput turned;
  turned.connection = 1;
  network_now_ns += 10 * ms;
  turned.arrived_ns = network_now_ns;
  turned.rotation_wxyz = {std::cos(0.1), 0, 0, std::sin(0.1)};
  link->input.store(turned);
  double before = 0.0;
  for (int t = 0; t <= 11; ++t, network_now_ns += ms) {
    const Mat3 r = read().world_from_handle.rotation;
    const double angle = std::atan2(r(1, 0), r(0, 0));
    EXPECT_LT(angle - before, 0.03);
    EXPECT_GE(angle, before - 1e-12);
    before = angle;
  }
  EXPECT_NEAR(before, 0.2, 1e-9);
}

TEST_F(NetworkDeviceTest, WhatItWritesGoesOutWithItsState) {
  arrive(0.0);
  read();
  network_now_ns += ms;
  read();
  DeviceOutput output;
  output.force_n = Vec3(1, 2, 3);
  output.torque_n_mm = Vec3(4, 5, 6);
  output.tick = 9;
  output.link = LinkState::held;
  output.engaged = true;
  output.thrust_n = 52.0;
  EXPECT_EQ(device.write(output), DeviceStatus::ok);
  RemoteOutput out;
  ASSERT_TRUE(link->output.take(out));
  EXPECT_EQ(out.force_n, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(out.torque_n_mm, (std::array<double, 3>{4, 5, 6}));
  EXPECT_EQ(out.tick, 9u);
  EXPECT_EQ(out.link, LinkState::held);
  EXPECT_EQ(out.connection, 1u);
  EXPECT_EQ(out.written_ns, network_now_ns);
  EXPECT_TRUE(out.engaged);
  device.close();
  ASSERT_TRUE(link->output.take(out));
  EXPECT_EQ(out.force_n, (std::array<double, 3>{0, 0, 0}));
}

TEST_F(NetworkDeviceTest, ForceIsTakenAwayUntilItIsOpenedAgain) {
  device.take_force_away();
  EXPECT_TRUE(link->force_taken_away);
  device.open();
  EXPECT_FALSE(link->force_taken_away);
}

TEST_F(NetworkDeviceTest, IsAnImpedanceDevice) {
  EXPECT_EQ(device.traits().profile, "touch");
  test::expect_error(ErrorKind::invalid_input, "impedance",
                     [] { NetworkDevice("hapticmaster", std::make_shared<RemoteLink>()); });
}

}  // namespace
}  // namespace ream::device
