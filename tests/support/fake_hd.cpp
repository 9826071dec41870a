// A libHD.so with one Touch in it: exports the maker's symbols, and fake_hardware() for tests. Its servo loop
// is a thread of its own at 1 kHz, which calls back as the maker's does; a force acts until a frame sets
// another or force output is disabled. The hand moves on 1 ms with each frame.
#include <poll.h>

#include <chrono>
#include <cstring>
#include <thread>

#include "support/fake_hardware.hpp"

namespace {

using ream::test::FakeHardware;
using ream::test::HardwareFault;

constexpr double step_s = 0.001, max_force_n = 3.3, max_continuous_force_n = 0.88;
constexpr unsigned invalid_device = 0xFFFFFFFF, the_device = 7;
constexpr unsigned comm_error = 0x0302, bad_handle = 0x0104, frame_error = 0x0402,
                   exceeded_max_force = 0x0201;

/// A frame that comes later than this was late for everybody: a busy machine held the servo loop up.
constexpr double stall_s = 0.05, remembered_s = 1.0;

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct ErrorInfo {
  unsigned code;
  int internal_code;
  unsigned device;
};

struct Device {
  FakeHardware hardware;
  std::atomic<bool> open{false}, forced{false}, running{false}, in_frame{false};
  std::atomic<unsigned> error{0};
  unsigned (*callback)(void*) = nullptr;
  void* user = nullptr;
  std::array<double, 3> force_n{}, torque_n_mm{};
  std::atomic<double> last_frame_s{0.0}, last_stall_s{-remembered_s};
  std::thread servo_loop;

  /// Whether frames have come in time lately.
  bool keeps_time() const {
    const double now = now_s();
    return now - last_frame_s < stall_s && now - last_stall_s > remembered_s;
  }

  void loop() {
    last_frame_s = now_s();
    while (running) {
      ::poll(nullptr, 0, 1);
      const double now = now_s();
      if (now - last_frame_s > stall_s) last_stall_s = now;
      last_frame_s = now;
      if (hardware.fault == HardwareFault::silent) continue;
      if (hardware.fault == HardwareFault::slow) ::poll(nullptr, 0, 15);
      if (callback != nullptr && callback(user) == 0) callback = nullptr;
    }
  }
};

Device& device() {
  static Device one;
  return one;
}

FakeHardware& hardware() { return device().hardware; }

}  // namespace

extern "C" {

FakeHardware* fake_hardware() { return &hardware(); }

unsigned hdInitDevice(const char*) {
  hardware().called("hdInitDevice");
  if (device().open || hardware().fault == HardwareFault::absent) {
    device().error = comm_error;
    return invalid_device;
  }
  device().open = true;
  return the_device;
}

void hdDisableDevice(unsigned id) {
  hardware().called("hdDisableDevice");
  if (id != the_device || !device().open) device().error = bad_handle;
  if (device().forced) hardware().refused("closed while its force is on");
  if (device().running) hardware().refused("closed while its servo loop runs");
  device().open = false;
}

void hdMakeCurrentDevice(unsigned) {}

void hdEnable(unsigned ability) {
  if (ability != 0x4000) return;
  hardware().called("hdEnable HD_FORCE_OUTPUT");
  device().forced = true;
}

void hdDisable(unsigned ability) {
  if (ability != 0x4000) return;
  hardware().called("hdDisable HD_FORCE_OUTPUT");
  // A servo loop that stands still cannot be told a last frame.
  const bool answers = hardware().fault == HardwareFault::none && device().keeps_time();
  if (answers && hardware().force_now_n() > 0.0)
    hardware().refused("its force is switched off while it pushes");
  device().forced = false;
  hardware().off();
}

void hdStartScheduler() {
  hardware().called("hdStartScheduler");
  device().running = true;
  device().servo_loop = std::thread([] { device().loop(); });
}

void hdStopScheduler() {
  hardware().called("hdStopScheduler");
  device().running = false;
  if (device().servo_loop.joinable()) device().servo_loop.join();
}

unsigned long hdScheduleAsynchronous(unsigned (*callback)(void*), void* user, unsigned short) {
  hardware().called("hdScheduleAsynchronous");
  device().user = user;
  device().callback = callback;
  return 1;
}

void hdUnschedule(unsigned long) {
  hardware().called("hdUnschedule");
  device().callback = nullptr;
}

void hdBeginFrame(unsigned id) {
  if (id != the_device || device().in_frame) device().error = frame_error;
  device().in_frame = true;
}

void hdEndFrame(unsigned) {
  device().in_frame = false;
  if (hardware().fault == HardwareFault::absent) {
    device().error = comm_error;
    hardware().off();
    return;
  }
  if (std::hypot(device().force_n[0], device().force_n[1], device().force_n[2]) > max_force_n + 1e-9) {
    device().error = exceeded_max_force;
    hardware().refused("a force beyond the device's limit");
  }
  if (device().forced) hardware().render(device().force_n, device().torque_n_mm);
}

void hdGetDoublev(unsigned parameter, double* values) {
  if (parameter == 0x2603) *values = max_force_n;
  if (parameter == 0x2604) *values = max_continuous_force_n;
  if (parameter != 0x2052) return;
  if (!device().in_frame) device().error = frame_error;
  const auto place_mm = hardware().move_hand(step_s);
  const double m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, place_mm[0], place_mm[1], place_mm[2], 1};
  std::memcpy(values, m, sizeof m);
  if (hardware().fault == HardwareFault::not_finite) values[12] = std::nan("");
  if (hardware().fault == HardwareFault::absurd) values[13] = 1e6;
  if (hardware().fault == HardwareFault::malformed) values[0] = values[5] = 0.0;
}

void hdGetIntegerv(unsigned parameter, int* values) {
  if (parameter == 0x2000) *values = static_cast<int>(hardware().buttons);
}

void hdSetDoublev(unsigned parameter, const double* values) {
  if (!device().in_frame) device().error = frame_error;
  if (parameter == 0x2700) std::copy_n(values, 3, device().force_n.begin());
  if (parameter == 0x2701) hardware().refused("a torque for a device that has none");
}

ErrorInfo hdGetError() { return {device().error.exchange(0), 0, the_device}; }

const char* hdGetErrorString(unsigned code) { return code == comm_error ? "Communication error" : "Error"; }

}  // extern "C"
