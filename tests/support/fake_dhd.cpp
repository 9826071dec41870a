// A libdhd.so with one omega.3 or sigma.7 in it: exports the maker's symbols, and fake_hardware() for tests.
// It is the library's number 0 and has the id 3 once it is open. Its firmware's watchdog switches the force
// off; the hand moves on 1 ms with each force.
#include <poll.h>

#include <thread>

#include "support/fake_hardware.hpp"

namespace {

using ream::test::FakeHardware;
using ream::test::HardwareFault;

constexpr double mm_per_m = 1000.0, step_s = 0.001, watchdog_period_ms = 0.125;
constexpr char the_id = 3;

struct Device {
  FakeHardware hardware;
  std::atomic<bool> open{false}, forced{false}, expert{false}, leaving{false};
  std::atomic<double> watchdog_ms{0.0}, max_force_n{1e9};
  std::atomic<int64_t> told_ns{0};
  std::thread firmware{[this] { watch(); }};

  ~Device() {
    leaving = true;
    firmware.join();
  }
  void watch() {
    while (!leaving) {
      ::poll(nullptr, 0, 1);
      const double limit_ms = watchdog_ms;
      if (!forced || limit_ms <= 0.0 ||
          static_cast<double>(ream::test::monotonic_ns() - told_ns) * 1e-6 < limit_ms)
        continue;
      // As the firmware does: forces come back with the next command.
      if (hardware.force_now_n() > 0.0) hardware.off();
    }
  }
};

Device& device() {
  static Device one;
  return one;
}

FakeHardware& hardware() { return device().hardware; }

/// Whether the device answers; a silent one keeps its caller until it speaks again.
bool answers(char id) {
  if (id != the_id) hardware().refused("a call for id " + std::to_string(id));
  while (hardware().fault == HardwareFault::silent) ::poll(nullptr, 0, 1);
  if (hardware().fault == HardwareFault::slow) ::poll(nullptr, 0, 15);
  return device().open && hardware().fault != HardwareFault::absent;
}

}  // namespace

extern "C" {

FakeHardware* fake_hardware() { return &hardware(); }

int dhdGetDeviceCount() { return hardware().fault == HardwareFault::absent ? 0 : 1; }

int dhdOpenID(char id) {
  hardware().called("dhdOpenID");
  if (id != 0 || device().open || hardware().fault == HardwareFault::absent) return -1;
  device().open = true;
  return the_id;
}

int dhdClose(char id) {
  hardware().called("dhdClose");
  if (id != the_id) hardware().refused("another id is closed");
  if (device().open && device().forced) hardware().refused("closed while its force is on");
  device().open = device().forced = false;
  device().watchdog_ms = 0.0;
  return 0;
}

const char* dhdGetSystemName(char) { return "omega.3"; }
const char* dhdErrorGetLastStr() { return "communication error"; }

int dhdEnableExpertMode() {
  device().expert = true;
  return 0;
}
int dhdDisableExpertMode() {
  device().expert = false;
  return 0;
}

int dhdSetWatchdog(unsigned char periods, char id) {
  if (id != the_id) return -1;
  hardware().called("dhdSetWatchdog " + std::to_string(periods));
  if (!device().expert) return -1;
  device().told_ns = ream::test::monotonic_ns();
  device().watchdog_ms = periods * watchdog_period_ms;
  return 0;
}

int dhdSetMaxForce(double newtons, char) {
  hardware().called("dhdSetMaxForce");
  device().max_force_n = newtons;
  return 0;
}

int dhdEnableForce(unsigned char on, char id) {
  if (id != the_id) return -1;
  hardware().called(on != 0 ? "dhdEnableForce on" : "dhdEnableForce off");
  if (!device().open) return -1;
  if (on != 0 && device().watchdog_ms == 0.0) hardware().refused("its force is on without a watchdog");
  if (on == 0 && hardware().fault == HardwareFault::none && hardware().force_now_n() > 0.0)
    hardware().refused("its force is switched off while it pushes");
  device().forced = on != 0;
  if (on != 0 && hardware().fault == HardwareFault::force_off) hardware().fault = HardwareFault::none;
  if (on == 0) hardware().off();
  return 0;
}

bool dhdHasWrist(char) { return false; }

int dhdGetStatus(int status[], char id) {
  for (int i = 0; i < 16; ++i) status[i] = 0;
  status[0] = status[1] = status[2] = status[3] = 1;
  status[5] = device().forced ? 1 : 0;
  return answers(id) ? 0 : -1;
}

int dhdGetPositionAndOrientationFrame(double* x, double* y, double* z, double r[3][3], char id) {
  if (!answers(id)) return -1;
  const auto place_mm = hardware().move_hand(step_s);
  *x = place_mm[0] / mm_per_m;
  *y = place_mm[1] / mm_per_m;
  *z = place_mm[2] / mm_per_m;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) r[row][column] = row == column ? 1.0 : 0.0;
  if (hardware().fault == HardwareFault::not_finite) *y = std::nan("");
  if (hardware().fault == HardwareFault::absurd) *y = 1000.0;
  // A device of three axes says nothing of its turn, so what makes no sense is where it is.
  if (hardware().fault == HardwareFault::malformed) *z = std::numeric_limits<double>::infinity();
  return 0;
}

unsigned dhdGetButtonMask(char) { return hardware().buttons; }

int dhdSetForceAndTorqueAndGripperForce(double fx, double fy, double fz, double tx, double ty, double tz,
                                        double, char id) {
  if (!answers(id)) return -1;
  device().told_ns = ream::test::monotonic_ns();
  if (hardware().fault == HardwareFault::force_off) {
    device().forced = false;
    hardware().off();
    return 0;
  }
  const double force_n = std::hypot(fx, fy, fz);
  if (force_n > device().max_force_n + 1e-9) hardware().refused("a force beyond the device's limit");
  if (!device().forced && force_n > 0.0) hardware().refused("a force before it was switched on");
  hardware().render({fx, fy, fz}, {mm_per_m * tx, mm_per_m * ty, mm_per_m * tz});
  return device().forced ? 0 : 1;  // the time guard's answer, which is no error
}

}  // extern "C"
