// What sessions with Haply's Inverse3 do not show: both forms of a force, hands without a grip, the service's
// own scale of forces, its emergency brake, and what it is told first and last.
#include <algorithm>
#include <cmath>
#include <memory>

#include "device/profiles.hpp"
#include "device/vendors/haply_servo.hpp"
#include "loop/ticked_device.hpp"
#include "support/fake_haply.hpp"

namespace ream::test {
namespace {

class Haply : public TickedDevice {
 protected:
  void open(const FakeHaply::Setting& setting, device::HaplyForceForm form = device::HaplyForceForm::vector) {
    fake = std::make_unique<FakeHaply>(setting);
    device::DeviceSetup setup = device::default_device_setup("haply");
    setup.connection.port = fake->port();
    setup.connection.events_port = fake->events_port();
    setup.connection.force_form = form;
    const device::DeviceTraits traits = device::device_profile("inverse3");
    device = std::make_unique<device::ServoDevice>(traits, device::make_haply_servo(setup, traits));
    device->open();
  }
  bool feels(double force_n) { return std::abs(fake->hardware().force_now_n() - force_n) < 1e-6; }

  std::unique_ptr<FakeHaply> fake;
};

TEST_F(Haply, IsConfiguredFirstAndToldNoForceLastInEitherForm) {
  for (const auto form : {device::HaplyForceForm::vector, device::HaplyForceForm::values}) {
    open({}, form);
    until([&] { return feels(2.0); });
    device->close();
    const std::vector<std::string> messages = fake->messages();
    const std::string word = form == device::HaplyForceForm::vector ? "vector" : "values";
    EXPECT_EQ(
        messages.front(),
        R"({"session":{"configure":{"profile":{"name":"ream.simulator:main"}}},"inverse3":[{"device_id":"049D",)"
        R"("commands":{"set_cursor_force":{")" +
            word + R"(":{"x":0,"y":0,"z":0}}}}]})");
    const std::string pushes = R"({"inverse3":[{"device_id":"049D","commands":{"set_cursor_force":{")" +
                               word + R"(":{"x":0,"y":0,"z":2}}}}]})";
    EXPECT_NE(std::find(messages.begin(), messages.end(), pushes), messages.end());
    EXPECT_EQ(fake->hardware().samples().back().force_n, 0.0);
    EXPECT_TRUE(fake->hardware().refusals().empty()) << fake->hardware().refusals().front();
  }
}

TEST_F(Haply, WithoutAGripTurnsItsSpindleAndPointsAsPlanned) {
  FakeHaply::Setting setting;
  setting.grip = false;
  open(setting);
  until([&] { return feels(2.0); });
  EXPECT_TRUE(input.spindle_on);
  EXPECT_FALSE(input.clutch || input.paused);
  const device::DeviceSetup setup = device::default_device_setup("haply");
  EXPECT_LT((input.world_from_handle.rotation - device::unsensed_rotation(setup)).norm(), 1e-9);
}

TEST_F(Haply, GivesTheGripsTurnAndButtons) {
  FakeHaply::Setting setting;
  setting.grip_wxyz = {0, 1, 0, 0};
  open(setting);
  fake->hardware().buttons = 2;
  until([&] { return input.clutch; });
  EXPECT_FALSE(input.spindle_on);
  EXPECT_LT((input.world_from_handle.rotation.diagonal() - Vec3(1, -1, -1)).norm(), 1e-9);
  fake->hardware().buttons = 5;
  until([&] { return input.paused && input.spindle_on && !input.clutch; });
}

TEST_F(Haply, IsSentLessWhereTheServiceEnlarges) {
  FakeHaply::Setting setting;
  setting.force_scale = 4.0;
  open(setting);
  until([&] { return feels(2.0); });
  EXPECT_LE(fake->hardware().largest_force_n(), 2.0 + 1e-6);
}

TEST_F(Haply, IsSentLessWhereTheProfileEnlarges) {
  FakeHaply::Setting setting;
  setting.profile_force_scale = 4.0;
  open(setting);
  until([&] { return feels(2.0); });
  EXPECT_LE(fake->hardware().largest_force_n(), 2.0 + 1e-6);
}

TEST_F(Haply, RestsWithItsButtonsReleasedWhileItsGripIsLost) {
  for (const FakeHaply::Grip loss : {FakeHaply::Grip::gone, FakeHaply::Grip::not_connected}) {
    open({});
    until([&] { return input.spindle_on && input.deadman && !input.paused; });
    fake->grip_now = loss;
    until([&] { return !input.spindle_on && !input.deadman && input.paused; });
    EXPECT_FALSE(input.clutch);
    fake->grip_now = FakeHaply::Grip::there;
    until([&] { return input.spindle_on && input.deadman && !input.paused; });
    device->close();
  }
}

TEST_F(Haply, AGripThatSaysNothingOfItsButtonsDoesNotTurnTheSpindle) {
  FakeHaply::Setting setting;
  setting.grip_says_buttons = false;
  open(setting);
  until([&] { return feels(2.0); });
  EXPECT_FALSE(input.spindle_on);
  EXPECT_FALSE(input.paused);
}

TEST_F(Haply, RestsWhileItsEmergencyBrakeIsOn) {
  open({});
  until([&] { return feels(2.0); });
  const auto brake = [&](const char* type) {
    fake->tell_event({{"name", "device-safety-triggered"},
                      {"category", "device"},
                      {"level", "error"},
                      {"data", {{"device_id", FakeHaply::id}, {"safety_type", type}}},
                      {"message", "told by a test"}});
  };
  brake("ebrake_triggered");
  until([&] { return input.paused; });
  brake("ebrake_released");
  until([&] { return !input.paused; });
}

}  // namespace
}  // namespace ream::test
