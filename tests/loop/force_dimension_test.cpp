// What sessions with Force Dimension's devices do not show: which of several is meant, and a force that is
// switched off at the device.
#include "device/vendors/force_dimension_servo.hpp"

#include <algorithm>
#include <cmath>

#include "device/profiles.hpp"
#include "loop/hardware_bench.hpp"
#include "loop/ticked_device.hpp"

namespace ream::test {
namespace {

class ForceDimension : public TickedDevice {
 protected:
  ForceDimension() {
    bench->begin();
    setup.connection.library = bench->connection().at("library");
  }
  void open() {
    const device::DeviceTraits traits = device::device_profile("omega.3");
    device = std::make_unique<device::ServoDevice>(traits, device::make_force_dimension_servo(setup, traits));
    device->open();
  }
  bool feels(double force_n) { return std::abs(bench->hardware().force_now_n() - force_n) < 1e-6; }
  int64_t times(const std::string& call) {
    const std::vector<std::string> calls = bench->hardware().calls();
    return std::count(calls.begin(), calls.end(), call);
  }

  std::unique_ptr<HardwareBench> bench = make_bench("forcedimension");
  device::DeviceSetup setup = device::default_device_setup("forcedimension");
};

TEST_F(ForceDimension, IsAskedUnderTheIdThatOpeningGave) {
  setup.connection.device_id = "0";
  open();
  until([&] { return feels(2.0); });
  device->close();
  EXPECT_TRUE(bench->hardware().refusals().empty()) << bench->hardware().refusals().front();
}

TEST_F(ForceDimension, IsOpenedAnewWhenItsForceWasSwitchedOff) {
  open();
  until([&] { return feels(2.0); });
  EXPECT_EQ(times("dhdOpenID"), 1);
  bench->make(HardwareFault::force_off);
  until([&] { return times("dhdOpenID") == 2; });
  EXPECT_EQ(times("dhdClose"), 1);
  until([&] { return feels(2.0); });
  device->close();
  EXPECT_TRUE(bench->hardware().refusals().empty()) << bench->hardware().refusals().front();
}

TEST_F(ForceDimension, RefusesADeviceIdThatIsNoNumber) {
  for (const char* wrong : {"a", "-1", "0x0", "0 ", " 0", "1.0", "99999999999999999999"}) {
    setup.connection.device_id = wrong;
    const std::string why = device::force_dimension_fault(setup);
    EXPECT_NE(why.find("device_id must be a number from 0"), std::string::npos) << wrong << ": " << why;
  }
  setup.connection.device_id = "1";
  EXPECT_NE(device::force_dimension_fault(setup).find("finds 1 devices and number 1"), std::string::npos);
  setup.connection.device_id = "0";
  EXPECT_EQ(device::force_dimension_fault(setup), "");
}

}  // namespace
}  // namespace ream::test
