#include "device/mapped_device.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/random_pose.hpp"

namespace ream::device {
namespace {

constexpr double never_ms = std::numeric_limits<double>::infinity();

/// Says what the test tells it to, and remembers what it is told.
class ToldDevice final : public HapticDevice {
 public:
  struct Memory {
    DeviceInput says;
    DeviceOutput heard;
    bool open = false, force_taken_away = false;
  };
  explicit ToldDevice(Memory& memory) : memory_(memory) {
    traits_.force_max_n = 10.0;
    traits_.torque_max_n_mm = 100.0;
    traits_.stiffness_max_n_mm = 2.0;
    traits_.workspace_radius_mm = 80.0;
  }
  const DeviceTraits& traits() const noexcept override { return traits_; }
  void open() override { memory_.open = true; }
  void close() noexcept override { memory_.open = false; }
  DeviceStatus read(DeviceInput& input) noexcept override {
    input = memory_.says;
    return DeviceStatus::ok;
  }
  DeviceStatus write(const DeviceOutput& output) noexcept override {
    memory_.heard = output;
    return DeviceStatus::ok;
  }
  void take_force_away() noexcept override { memory_.force_taken_away = true; }
  void session_paused(bool) noexcept override {}
  double closing_ms() const noexcept override { return 0.0; }
  void use_priority(int) noexcept override {}

 private:
  Memory& memory_;
  DeviceTraits traits_;
};

/// A device with a set-up of its own before a plan of its own.
struct Mapped {
  explicit Mapped(uint32_t seed) : random(seed) {
    setup.person_from_device = test::random_pose(random).rotation;
    setup.scale = 2.0;
    start = test::random_pose(random, 50.0);
    device = std::make_unique<MappedDevice>(std::make_unique<ToldDevice>(memory), setup, start);
    device->open();
    memory.says.world_from_handle.translation_mm = test::random_vector(random, 50.0);
  }
  Pose read(int ticks = 1) {
    for (int i = 0; i < ticks; ++i) EXPECT_EQ(device->read(input), DeviceStatus::ok);
    return input.world_from_handle;
  }
  /// The device's frame, of what a person does in theirs.
  Vec3 device_mm(const Vec3& person_mm) const { return setup.person_from_device.transpose() * person_mm; }
  Vec3& place_mm() { return memory.says.world_from_handle.translation_mm; }

  std::mt19937 random;
  DeviceSetup setup;
  Pose start;
  ToldDevice::Memory memory;
  std::unique_ptr<MappedDevice> device;
  DeviceInput input;
};

TEST(MappedDevice, BeginsAtTheStartWhereverTheHandIs) {
  Mapped m(1);
  m.memory.says.age_ms = never_ms;
  EXPECT_EQ(m.read().translation_mm, m.start.translation_mm);
  EXPECT_TRUE(m.input.paused) << "nobody has connected yet";
  m.memory.says.age_ms = 0.0;
  EXPECT_LT((m.read().translation_mm - m.start.translation_mm).norm(), 1e-12);
  EXPECT_FALSE(m.input.paused);
}

TEST(MappedDevice, AwayFromThePersonGoesIntoTheBoneByTheScale) {
  Mapped m(2);
  m.read();
  for (int i = 0; i < 10; ++i) {
    m.place_mm() += m.device_mm(Vec3(0, 0, -0.5));
    m.read();
  }
  const Vec3 way_mm = m.input.world_from_handle.translation_mm - m.start.translation_mm;
  EXPECT_LT((way_mm - m.setup.scale * 5.0 * m.start.rotation.col(2)).norm(), 1e-9);
}

TEST(MappedDevice, AHandleWithoutATurnAlongThePersonsAxesPointsIntoTheBone) {
  Mapped m(3);
  m.memory.says.world_from_handle.rotation = m.setup.person_from_device.transpose();
  m.read(4000);
  EXPECT_LT((m.input.world_from_handle.rotation.col(2) - m.start.rotation.col(2)).norm(), 1e-9);
}

/// What the hand puts in is what the world takes, but for the scale, of forces and torques alike.
TEST(MappedDevice, WorkIsSmallerInTheHandByTheScale) {
  Mapped m(4);
  m.read(4000);
  for (int i = 0; i < 50; ++i) {
    const Pose device_before = m.memory.says.world_from_handle, world_before = m.input.world_from_handle;
    const Vec3 turn_rad = test::random_vector(m.random, 1e-4);
    m.place_mm() += test::random_vector(m.random, 0.3);
    m.memory.says.world_from_handle.rotation = rotation_from_small_vector(turn_rad) * device_before.rotation;
    m.read();
    DeviceOutput output;
    output.force_n = test::random_vector(m.random, 5.0);
    output.torque_n_mm = test::random_vector(m.random, 50.0);
    m.device->write(output);
    const Vec3 world_turn_rad =
        small_vector_from_rotation(m.input.world_from_handle.rotation * world_before.rotation.transpose());
    const double world_mj =
        output.force_n.dot(m.input.world_from_handle.translation_mm - world_before.translation_mm) +
        output.torque_n_mm.dot(world_turn_rad);
    const double hand_mj = m.memory.heard.force_n.dot(m.place_mm() - device_before.translation_mm) +
                           m.memory.heard.torque_n_mm.dot(turn_rad);
    EXPECT_NEAR(m.setup.scale * hand_mj, world_mj, 1e-9 + 1e-6 * std::abs(world_mj));
    EXPECT_NEAR(m.memory.heard.force_n.norm(), output.force_n.norm(), 1e-12) << "a newton is a newton";
  }
}

TEST(MappedDevice, TraitsAreThoseThatTheWorldSees) {
  const Mapped m(5);
  const DeviceTraits& traits = m.device->traits();
  EXPECT_EQ(traits.force_max_n, 10.0);
  EXPECT_EQ(traits.torque_max_n_mm, 200.0);
  EXPECT_EQ(traits.stiffness_max_n_mm, 1.0) << "twice the way, the same force";
  EXPECT_EQ(traits.workspace_radius_mm, 160.0);
}

enum class Rest { clutch, deadman, pause, lost, wild };

class MappedDeviceRests : public testing::TestWithParam<Rest> {};

/// Whatever lets the handle rest: it stays where it is, feels nothing, and goes on from there.
TEST_P(MappedDeviceRests, AndGoesOnFromThere) {
  Mapped m(6);
  m.memory.says.spindle_on = true;
  m.read(10);
  const Pose before = m.input.world_from_handle;
  DeviceInput& says = m.memory.says;
  const bool wild = GetParam() == Rest::wild;
  says.clutch = GetParam() == Rest::clutch;
  says.deadman = GetParam() != Rest::deadman;
  says.paused = GetParam() == Rest::pause;
  if (GetParam() == Rest::lost) says.age_ms = never_ms;
  for (int i = 0; i < 100; ++i) {
    if (!wild) m.place_mm() += test::random_vector(m.random, 3.0);
    m.read();
    if (wild) continue;
    EXPECT_TRUE(m.input.paused);
    EXPECT_LT((m.input.world_from_handle.translation_mm - before.translation_mm).norm(), 1e-9);
    EXPECT_EQ(m.input.world_from_handle.rotation, before.rotation);
    DeviceOutput output;
    output.force_n = Vec3(1, 2, 3);
    m.device->write(output);
    EXPECT_EQ(m.memory.heard.force_n, Vec3(Vec3::Zero()));
  }
  EXPECT_EQ(m.input.spindle_on, GetParam() != Rest::deadman);
  if (wild) m.place_mm() += Vec3(40, 0, 0);  // in one millisecond
  says.clutch = says.paused = false;
  says.deadman = true;
  says.age_ms = 0.0;
  const Pose after = m.read();
  EXPECT_FALSE(m.input.paused);
  EXPECT_LT((after.translation_mm - before.translation_mm).norm(), wild ? 1e-9 : 1e-6);
  m.place_mm() += m.device_mm(Vec3(1, 0, 0));
  EXPECT_NEAR((m.read().translation_mm - after.translation_mm).norm(), m.setup.scale, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Every, MappedDeviceRests,
                         testing::Values(Rest::clutch, Rest::deadman, Rest::pause, Rest::lost, Rest::wild));

TEST(MappedDevice, AfterARestItTurnsNoFasterThanItMayAndThenExactlyAsTheHandleDoes) {
  Mapped m(7);
  m.read(4000);
  m.memory.says.clutch = true;
  m.memory.says.world_from_handle.rotation =
      test::rotation_about(Vec3::UnitX(), 1.0) * m.memory.says.world_from_handle.rotation;
  m.read(10);
  m.memory.says.clutch = false;
  int ticks = 0;
  for (Mat3 before = m.input.world_from_handle.rotation;; before = m.input.world_from_handle.rotation) {
    m.read();
    const double turned_rad = turn_between(before, m.input.world_from_handle.rotation).norm();
    EXPECT_LT(turned_rad, 1.01e-3 * MappedDevice::turn_rate_rad_s);
    if (turned_rad == 0.0 || ++ticks > 1000) break;
  }
  EXPECT_NEAR(ticks, 500, 5);
  m.memory.says.world_from_handle.rotation =
      test::rotation_about(Vec3::UnitY(), 0.1) * m.memory.says.world_from_handle.rotation;
  const Mat3 before = m.input.world_from_handle.rotation;
  m.read();
  EXPECT_NEAR(turn_between(before, m.input.world_from_handle.rotation).norm(), 0.1, 1e-3);
}

TEST(MappedDevice, APoseThatIsNotANumberCountsAsNothingSaid) {
  Mapped m(8);
  m.read(5);
  const Pose before = m.input.world_from_handle;
  const Vec3 good_mm = m.place_mm();
  m.place_mm().y() = std::numeric_limits<double>::quiet_NaN();
  m.read(20);
  EXPECT_NEAR(m.input.age_ms, 20.0, 1e-9);
  EXPECT_EQ(m.input.world_from_handle.translation_mm, before.translation_mm);
  m.read(40);
  EXPECT_TRUE(m.input.paused) << "as good as lost";
  m.place_mm() = good_mm;
  m.read();
  EXPECT_EQ(m.input.age_ms, 0.0);
  EXPECT_LT((m.input.world_from_handle.translation_mm - before.translation_mm).norm(), 1e-12);
}

TEST(MappedDevice, AnAdmittanceDeviceIsPutWhereTheToolIs) {
  Mapped m(9);
  m.read(4000);
  DeviceOutput output;
  output.world_from_tool = m.input.world_from_handle;
  m.device->write(output);
  ASSERT_TRUE(m.memory.heard.world_from_tool.has_value());
  const Pose& said = m.memory.says.world_from_handle;
  EXPECT_LT((m.memory.heard.world_from_tool->translation_mm - said.translation_mm).norm(), 1e-9);
  EXPECT_LT((m.memory.heard.world_from_tool->rotation - said.rotation).norm(), 1e-9);
}

TEST(MappedDevice, TakesTheForceAwayFromTheDevice) {
  Mapped m(10);
  m.device->take_force_away();
  EXPECT_TRUE(m.memory.force_taken_away);
  m.device->close();
  EXPECT_FALSE(m.memory.open);
}

TEST(MappedDevice, AHandThatMovesWhileTheSessionIsPausedMovesNoTool) {
  Mapped m(21);
  m.read(10);
  const Pose before = m.read();
  m.device->session_paused(true);
  for (int i = 0; i < 100; ++i) {
    m.place_mm() += m.device_mm(Vec3(0.3, 0.2, -0.4));
    EXPECT_LT((m.read().translation_mm - before.translation_mm).norm(), 1e-9);
    EXPECT_TRUE(m.input.paused);
  }
  m.device->session_paused(false);
  EXPECT_LT((m.read().translation_mm - before.translation_mm).norm(), 1e-9);
  EXPECT_FALSE(m.input.paused);
  m.place_mm() += m.device_mm(Vec3(0, 0, -0.5));
  EXPECT_NEAR((m.read().translation_mm - before.translation_mm).norm(), 0.5 * m.setup.scale, 1e-9);
}

}  // namespace
}  // namespace ream::device
