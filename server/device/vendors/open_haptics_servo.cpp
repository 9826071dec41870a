#include "device/vendors/open_haptics_servo.hpp"

#include <poll.h>

#include <algorithm>
#include <atomic>
#include <optional>

#include "core/error.hpp"
#include "core/log.hpp"
#include "device/vendors/open_haptics_library.hpp"

namespace ream::device {
namespace {

using Library = OpenHapticsLibrary;

constexpr int hd_spindle_button = 1, hd_clutch_button = 2, hd_pause_button = 4;
constexpr int64_t lost_ns = static_cast<int64_t>(servo_loop_timeout_ms * 1e6);
constexpr int closing_wait_ms = 20;
/// That one look takes from the library's list.
constexpr int max_errors = 8;

class OpenHapticsServo final : public Servo {
 public:
  OpenHapticsServo(const DeviceSetup& setup, const DeviceTraits& traits)
      : config_(setup.connection),
        force_max_n_(traits.force_max_n),
        has_torque_(traits.torque_max_n_mm > 0.0) {}

  void open(ServoEnd& end) override {
    find();
    end_ = &end;
    frames_ = 0;
    error_ = Library::success;
    leaving_ = warm_ = warm_logged_ = stalled_ = false;
    clear_errors();
    device_ = hd().init_device(config_.device_id.empty() ? nullptr : config_.device_id.c_str());
    if (const unsigned failed = hd().get_error().code;
        failed != Library::success || device_ == Library::invalid_device)
      throw Error(ErrorKind::unavailable,
                  "the device cannot be opened: " + error_text(failed) +
                      "; check cable and power, and set it up with its maker's program");
    is_open_ = true;
    limit();
    hd().enable(Library::max_force_clamping);
    callback_ = hd().schedule_asynchronous(&OpenHapticsServo::call_back, this, Library::default_priority);
    hd().enable(Library::force_output);
    hd().start_scheduler();
    if (const unsigned failed = hd().get_error().code; failed != Library::success)
      throw Error(ErrorKind::unavailable, "its servo loop does not start: " + error_text(failed));
    last_frame_ns_ = end.now_ns();
  }

  /// Waits for a whole frame from now on.
  void turn(ServoEnd& end) override {
    const uint64_t seen = frames_;
    uint64_t newest = seen;
    while (frames_ < seen + 2) {
      if (const unsigned failed = error_; failed != Library::success)
        throw Error(ErrorKind::unavailable, error_text(failed) + "; check cable and power");
      if (frames_ != newest) {
        newest = frames_;
        last_frame_ns_ = end.now_ns();
      }
      stalled_ = end.now_ns() - last_frame_ns_ > lost_ns;
      if (stalled_) throw Error(ErrorKind::unavailable, "its servo loop stands still; check cable and power");
      ::poll(nullptr, 0, 1);
    }
    last_frame_ns_ = end.now_ns();
    if (warm_ && !warm_logged_)
      log::warn("openhaptics: its motors are warm; no more than their continuous force");
    warm_logged_ = warm_;
  }

  /// In the maker's servo loop.
  bool takes_force_elsewhere() const noexcept override { return true; }

  void find() {
    if (!hd_) hd_.emplace(config_.library);
  }

  void close() noexcept override {
    if (!is_open_) return;
    is_open_ = false;
    leaving_ = true;
    const uint64_t seen = frames_;
    for (int waited_ms = 0;
         waited_ms < closing_wait_ms && frames_ < seen + 2 && error_ == Library::success && !stalled_;
         ++waited_ms)
      ::poll(nullptr, 0, 1);
    hd().make_current_device(device_);
    hd().disable(Library::force_output);
    hd().stop_scheduler();
    hd().unschedule(callback_);
    hd().disable_device(device_);
  }

 private:
  const Library& hd() const { return *hd_; }

  std::string error_text(unsigned code) const {
    const char* text = hd().get_error_string(code);
    return code == Library::success || text == nullptr ? "no reason given" : text;
  }

  void clear_errors() const {
    for (int looked = 0; looked < max_errors && hd().get_error().code != Library::success; ++looked) {
    }
  }

  void limit() {
    double max_n = 0.0;
    hd().get_doubles(Library::nominal_max_force, &max_n);
    hd().get_doubles(Library::nominal_max_continuous_force, &continuous_n_);
    limit_n_ = max_n > 0.0 ? std::min(max_n, force_max_n_) : force_max_n_;
    end_->limit_force(limit_n_);
  }

  static unsigned call_back(void* servo) { return static_cast<OpenHapticsServo*>(servo)->frame(); }

  /// In the maker's servo loop.
  unsigned frame() noexcept {
    const int64_t begun_ns = end_->now_ns();
    hd().begin_frame(device_);
    double m[16] = {};
    int pressed = 0;
    hd().get_doubles(Library::transform, m);
    hd().get_integers(Library::buttons, &pressed);
    ServoState state;
    for (int column = 0; column < 3; ++column)
      for (int row = 0; row < 3; ++row) state.device_from_handle.rotation(row, column) = m[4 * column + row];
    state.device_from_handle.translation_mm = Vec3(m[12], m[13], m[14]);
    state.spindle_on = !config_.spindle_by_button || (pressed & hd_spindle_button) != 0;
    state.clutch = (pressed & hd_clutch_button) != 0;
    state.paused = (pressed & hd_pause_button) != 0;
    const ServoForce force = leaving_ ? ServoForce{} : end_->force();
    hd().set_doubles(Library::force, force.force_n.data());
    if (has_torque_) hd().set_doubles(Library::torque, force.torque_n_mm.data());
    hd().end_frame(device_);
    if (take_errors()) end_->report(state, begun_ns);
    ++frames_;
    return Library::callback_continue;
  }

  /// False when the device has failed.
  bool take_errors() noexcept {
    bool warm = false;
    for (int looked = 0; looked < max_errors; ++looked) {
      const unsigned code = hd().get_error().code;
      if (code == Library::success) break;
      warm |= code == Library::warm_motors;
      if (code >= Library::first_device_error && code <= Library::last_device_error) error_ = code;
    }
    if (warm && continuous_n_ > 0.0) end_->limit_force(std::min(continuous_n_, limit_n_));
    if (warm) warm_ = true;
    return error_ == Library::success;
  }

  const DeviceConnection config_;
  const double force_max_n_;
  const bool has_torque_;
  std::optional<Library> hd_;
  ServoEnd* end_ = nullptr;
  unsigned device_ = Library::invalid_device;
  unsigned long callback_ = 0;
  double limit_n_ = 0.0, continuous_n_ = 0.0;
  int64_t last_frame_ns_ = 0;
  bool is_open_ = false, warm_logged_ = false, stalled_ = false;
  std::atomic<uint64_t> frames_{0};
  std::atomic<unsigned> error_{Library::success};
  std::atomic<bool> leaving_{false}, warm_{false};
};

}  // namespace

std::unique_ptr<Servo> make_open_haptics_servo(const DeviceSetup& setup, const DeviceTraits& traits) {
  return std::make_unique<OpenHapticsServo>(setup, traits);
}

std::string open_haptics_fault(const DeviceSetup& setup) {
  try {
    OpenHapticsServo(setup, {}).find();
    return "";
  } catch (const Error& e) {
    return e.what();
  }
}

}  // namespace ream::device
