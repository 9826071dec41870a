#include "device/force_dimension_servo.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "core/error.hpp"
#include "device/force_dimension_library.hpp"

namespace ream::device {
namespace {

constexpr double mm_per_m = 1000.0, watchdog_period_ms = 0.125;
constexpr unsigned char on = 1, off = 0;
/// Places in what dhdGetStatus tells, and of how many.
constexpr size_t status_count = 32, reset_status = 3;
constexpr unsigned spindle_button = 1, clutch_button = 2, pause_button = 4;

class ForceDimensionServo final : public Servo {
 public:
  ForceDimensionServo(const DeviceSetup& setup, const DeviceTraits& traits)
      : wanted_(setup.connection), unsensed_(unsensed_rotation(setup)), force_max_n_(traits.force_max_n) {}

  void open(ServoEnd& end) override {
    find();
    const int opened = dhd().open_id(id_);
    if (opened < 0)
      throw Error(ErrorKind::unavailable, "the device cannot be opened: " + dhd().last_error() +
                                              "; check cable and power, and that no other program has it");
    is_open_ = true;
    make_safe();
    require_calibration();
    has_wrist_ = dhd().has_wrist(id_);
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
    state.spindle_on = !wanted_.spindle_by_button || (pressed & spindle_button) != 0;
    state.clutch = (pressed & clutch_button) != 0;
    state.paused = (pressed & pause_button) != 0;
    end.tell(state, asked_ns);
    render(end.force());
  }

  /// The library and the number of the device.
  void find() {
    if (!dhd_) dhd_.emplace(wanted_.library);
    const int count = dhd().get_device_count();
    const int wanted = wanted_.device_id.empty() ? 0 : std::atoi(wanted_.device_id.c_str());
    if (wanted >= 0 && wanted < count) {
      id_ = static_cast<char>(wanted);
      return;
    }
    throw Error(ErrorKind::unavailable,
                "the library finds " + std::to_string(std::max(0, count)) + " devices and number " +
                    std::to_string(wanted) +
                    " is wanted; check cable, power and the rights to USB, or device_id in the set-up");
  }

  void close() noexcept override {
    if (!is_open_) return;
    is_open_ = false;
    dhd().set_force_and_torque(0, 0, 0, 0, 0, 0, 0, id_);
    dhd().enable_force(off, id_);
    dhd().close(id_);
  }

 private:
  const ForceDimensionLibrary& dhd() const { return *dhd_; }

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

  void render(const ServoForce& force) const {
    const Vec3 torque_n_m = force.torque_n_mm / mm_per_m;
    require(dhd().set_force_and_torque(force.force_n.x(), force.force_n.y(), force.force_n.z(),
                                       torque_n_m.x(), torque_n_m.y(), torque_n_m.z(), 0.0, id_),
            "takes no force");
  }

  const DeviceConnection wanted_;
  const Mat3 unsensed_;
  const double force_max_n_;
  std::optional<ForceDimensionLibrary> dhd_;
  char id_ = 0;
  bool is_open_ = false, has_wrist_ = false;
};

}  // namespace

std::unique_ptr<Servo> make_force_dimension_servo(const DeviceSetup& setup, const DeviceTraits& traits) {
  return std::make_unique<ForceDimensionServo>(setup, traits);
}

std::string why_no_force_dimension(const DeviceSetup& setup) {
  try {
    ForceDimensionServo(setup, {}).find();
    return "";
  } catch (const Error& e) {
    return e.what();
  }
}

}  // namespace ream::device
