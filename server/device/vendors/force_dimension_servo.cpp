#include "device/vendors/force_dimension_servo.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/error.hpp"
#include "core/units.hpp"
#include "device/vendors/force_dimension_library.hpp"

namespace ream::device {
namespace {

constexpr double watchdog_period_ms = 0.125;
constexpr unsigned char on = 1, off = 0;
/// Places in what dhdGetStatus tells, and of how many.
constexpr size_t status_count = 32, reset_status = 3, force_status = 5;
constexpr int turns_between_checks = 100;
constexpr unsigned spindle_button = 1, clutch_button = 2, pause_button = 4;

class ForceDimensionServo final : public Servo {
 public:
  ForceDimensionServo(const DeviceSetup& setup, const DeviceTraits& traits)
      : config_(setup.connection), unsensed_(unsensed_rotation(setup)), force_max_n_(traits.force_max_n) {}

  void open(ServoEnd& end) override {
    find();
    const int opened = dhd().open_id(number_);
    if (opened < 0)
      throw Error(ErrorKind::unavailable, "the device cannot be opened: " + dhd().last_error() +
                                              "; check cable and power, and that no other program has it");
    id_ = static_cast<char>(opened);
    is_open_ = true;
    force_was_on_ = false;
    turns_ = 0;
    make_safe();
    require_calibration();
    has_wrist_ = dhd().has_wrist(id_);
    require_force_on();
    turn(end);
  }

  void turn(ServoEnd& end) override {
    const int64_t asked_ns = end.now_ns();
    ServoState state;
    double x_m = 0.0, y_m = 0.0, z_m = 0.0, rotation[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    require(dhd().get_pose(&x_m, &y_m, &z_m, rotation, id_), "tells no position");
    const unsigned pressed = dhd().get_button_mask(id_);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        state.device_from_handle.rotation(row, column) = rotation[row][column];
    if (!has_wrist_) state.device_from_handle.rotation = unsensed_;
    state.device_from_handle.translation_mm = mm_per_m * Vec3(x_m, y_m, z_m);
    state.spindle_on = !config_.spindle_by_button || (pressed & spindle_button) != 0;
    state.clutch = (pressed & clutch_button) != 0;
    state.paused = (pressed & pause_button) != 0;
    end.report(state, asked_ns);
    render(end.force());
    if (++turns_ % turns_between_checks == 0) require_force_on();
  }

  /// The library and the number of the device.
  void find() {
    if (!dhd_) dhd_.emplace(config_.library);
    const int count = dhd().get_device_count();
    const int target = configured_number();
    if (target < count) {
      number_ = static_cast<char>(target);
      return;
    }
    throw Error(ErrorKind::unavailable,
                "the library finds " + std::to_string(std::max(0, count)) + " devices and number " +
                    std::to_string(target) +
                    " is wanted; check cable, power and the rights to USB, or device_id in the set-up");
  }

  bool takes_force_elsewhere() const noexcept override { return false; }

  void close() noexcept override {
    if (!is_open_) return;
    is_open_ = false;
    dhd().set_force_and_torque(0, 0, 0, 0, 0, 0, 0, id_);
    dhd().enable_force(off, id_);
    dhd().close(id_);
  }

 private:
  const ForceDimensionLibrary& dhd() const { return *dhd_; }

  int configured_number() const {
    const std::string& text = config_.device_id;
    if (text.empty()) return 0;
    int number = -1;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failed != std::errc{} || end != text.data() + text.size() || number < 0)
      throw Error(ErrorKind::invalid_input,
                  "device_id must be a number from 0, not '" + text + "'; correct it in the set-up");
    return number;
  }

  void require(int answer, const char* what) const {
    if (answer < 0)
      throw Error(ErrorKind::unavailable,
                  std::string("the device ") + what + ": " + dhd().last_error() + "; check cable and power");
  }

  /// The watchdog runs before any force can.
  void make_safe() {
    require(dhd().set_force_and_torque(0, 0, 0, 0, 0, 0, 0, id_), "takes no force");
    require(dhd().enable_expert_mode(), "takes no watchdog");
    const int guarded = dhd().set_watchdog(static_cast<unsigned char>(watchdog_ms / watchdog_period_ms), id_);
    dhd().disable_expert_mode();
    require(guarded, "takes no watchdog");
    if (dhd().set_max_force != nullptr) dhd().set_max_force(force_max_n_, id_);
    require(dhd().enable_force(on, id_), "does not switch its force on");
  }

  void require_calibration() const {
    int status[status_count] = {};
    require(dhd().get_status(status, id_), "tells no status");
    if (status[reset_status] == 0)
      throw Error(
          ErrorKind::unavailable,
          "the device is not calibrated; follow its manual (reset button, or the maker's HapticInit), "
          "then start again");
  }

  /// Its watchdog, its velocity limit or the button at its foot may have switched the force off. It is closed
  /// then, so that what is switched on again rises from nothing.
  void require_force_on() {
    int status[status_count] = {};
    require(dhd().get_status(status, id_), "tells no status");
    const bool is_on = status[force_status] != 0;
    if (force_was_on_ && !is_on)
      throw Error(ErrorKind::unavailable,
                  "the device's force was switched off (its button, its watchdog or its velocity limit)");
    force_was_on_ = is_on;
  }

  void render(const ServoForce& force) const {
    const Vec3 torque_n_m = force.torque_n_mm / mm_per_m;
    require(dhd().set_force_and_torque(force.force_n.x(), force.force_n.y(), force.force_n.z(),
                                       torque_n_m.x(), torque_n_m.y(), torque_n_m.z(), 0.0, id_),
            "takes no force");
  }

  const DeviceConnection config_;
  const Mat3 unsensed_;
  const double force_max_n_;
  std::optional<ForceDimensionLibrary> dhd_;
  char number_ = 0;  ///< among the devices that the library finds
  char id_ = 0;      ///< that opening it gave
  bool is_open_ = false, has_wrist_ = false, force_was_on_ = false;
  uint64_t turns_ = 0;
};

}  // namespace

std::unique_ptr<Servo> make_force_dimension_servo(const DeviceSetup& setup, const DeviceTraits& traits) {
  return std::make_unique<ForceDimensionServo>(setup, traits);
}

std::string force_dimension_fault(const DeviceSetup& setup) {
  try {
    ForceDimensionServo(setup, {}).find();
    return "";
  } catch (const Error& e) {
    return e.what();
  }
}

}  // namespace ream::device
