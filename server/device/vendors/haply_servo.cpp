#include "device/vendors/haply_servo.hpp"

#include "core/error.hpp"
#include "core/log.hpp"
#include "core/units.hpp"
#include "device/vendors/haply_messages.hpp"
#include "net/websocket_client.hpp"

namespace ream::device {
namespace {

using namespace std::chrono_literals;

constexpr auto connecting = 1000ms, sending = 250ms, answering = 250ms, probing = 500ms;
/// So many useless frames one after the other, and the connection is begun anew.
constexpr int max_useless_frames = 100;
constexpr int turns_between_events = 10;
/// A grip that has not been told of for so long sleeps, is out of reach or has no battery any more.
constexpr int64_t grip_lost_ns = 50'000'000;

const std::string start_service =
    "; start Haply's Inverse Service (`systemctl start haply-inverse-service`), or correct host and port in "
    "the "
    "set-up";

/// The service with one device of it.
class HaplyServo final : public Servo {
 public:
  explicit HaplyServo(const DeviceSetup& setup)
      : config_(setup.connection),
        unsensed_(unsensed_rotation(setup)),
        reader_(config_.device_id, config_.grip_id) {}

  void open(ServoEnd& end) override {
    find(connecting);
    connect_events();
    braked_ = false;
    useless_ = 0;
    grip_lost_ = false;
    exchange(Vec3::Zero(), HaplyRequest::configure);
    const int64_t sent_ns = last_grip_ns_ = end.now_ns();
    // With the profile in effect, the service may scale forces by another number than before.
    exchange(Vec3::Zero(), HaplyRequest::full_state);
    if (!reader_.device().has_position)
      throw Error(ErrorKind::unavailable, service() + " tells no position of its Inverse3");
    end.report(state(), sent_ns);
  }

  /// Connects and takes the inventory.
  void find(std::chrono::milliseconds timeout) {
    try {
      client_.connect(config_.host, config_.port, "/", timeout);
    } catch (const Error& e) {
      throw Error(ErrorKind::unavailable, std::string("Haply's service at ") + e.what() + start_service);
    }
    try {
      const auto inventory = client_.receive(timeout);
      if (!inventory) throw Error(ErrorKind::unavailable, "it sent no inventory of devices");
      reader_.take_inventory(*inventory);
    } catch (const Error& e) {
      throw Error(ErrorKind::unavailable, service() + ": " + e.what());
    }
  }

  void turn(ServoEnd& end) override {
    const ServoForce target = end.force();
    const int64_t sent_ns = end.now_ns();
    if (exchange(target.force_n, HaplyRequest::nothing)) {
      watch_grip(sent_ns);
      end.report(state(), sent_ns);
    }
    if (++turns_ % turns_between_events == 0) receive_events();
  }

  bool takes_force_elsewhere() const noexcept override { return false; }

  void close() noexcept override {
    try {
      if (client_.is_open() && !reader_.device().device_id.empty()) {
        write_haply_message(message_, reader_.device().device_id, Vec3::Zero(), config_.force_form,
                            HaplyRequest::nothing);
        client_.send(message_, sending);
        client_.receive(50ms);
      }
    } catch (const std::exception&) {
      // A service that cannot be told has forgotten the force by itself.
    }
    client_.close();
    events_.close();
  }

 private:
  std::string service() const {
    return "Haply's service at " + config_.host + ":" + std::to_string(config_.port);
  }

  /// One message and the one frame that answers it. False: the frame is of no use.
  bool exchange(const Vec3& force_n, HaplyRequest command) {
    const HaplyDevice& device = reader_.device();
    // What the service scales up is sent smaller; where it scales down, no more than the device's limit.
    write_haply_message(message_, device.device_id, force_n / std::max(1.0, device.force_scale),
                        config_.force_form, command);
    try {
      client_.send(message_, sending);
      const auto frame = client_.receive(answering);
      if (!frame) throw Error(ErrorKind::unavailable, "it has not answered for a quarter of a second");
      std::string why;
      if (reader_.take_state(*frame, why)) {
        useless_ = 0;
        return true;
      }
      if (++useless_ > max_useless_frames) throw Error(ErrorKind::unavailable, why);
    } catch (const Error& e) {
      throw Error(ErrorKind::unavailable, service() + ": " + e.what());
    }
    return false;
  }

  bool should_have_grip() const { return !config_.grip_id.empty() || !reader_.device().grip_id.empty(); }

  void watch_grip(int64_t now_ns) {
    if (reader_.device().grip_reported) last_grip_ns_ = now_ns;
    const bool lost = should_have_grip() && now_ns - last_grip_ns_ > grip_lost_ns;
    if (lost) reader_.release_buttons();
    if (lost && !grip_lost_)
      log::warn(
          "haply: nothing is heard of the grip; the session rests until it is back (wake it up, or look at "
          "its battery)");
    if (!lost && grip_lost_) log::info("haply: the grip is back");
    grip_lost_ = lost;
  }

  ServoState state() const {
    const HaplyDevice& device = reader_.device();
    ServoState state;
    state.device_from_handle = {
        device.has_grip ? rotation_from_quaternion(device.orientation_wxyz) : unsensed_,
        mm_per_m * device.position_m};
    // A grip that has not said anything of its buttons yet has not switched the spindle on.
    const bool by_button = config_.spindle_by_button && (device.has_buttons || should_have_grip());
    state.spindle_on = !grip_lost_ && (!by_button || device.button_a);
    state.clutch = device.button_b;
    state.paused = device.button_c || braked_ || grip_lost_;
    state.deadman = !grip_lost_;
    return state;
  }

  void connect_events() {
    if (config_.events_port == 0) return;
    try {
      events_.connect(config_.host, config_.events_port, "/", probing);
    } catch (const Error& e) {
      log::info(std::string("haply: without its safety events: ") + e.what());
    }
  }

  void receive_events() {
    if (!events_.is_open()) return;
    std::optional<HaplyEvent> event;
    try {
      if (const auto text = events_.receive(0ms)) event = read_haply_event(*text, reader_.device().device_id);
    } catch (const Error& e) {
      log::warn(std::string("haply: its safety events ended: ") + e.what());
    }
    if (!event || event->kind == HaplyEvent::Kind::nothing) return;
    if (event->kind == HaplyEvent::Kind::gone) throw Error(ErrorKind::unavailable, event->text);
    if (event->kind != HaplyEvent::Kind::warning) braked_ = event->kind == HaplyEvent::Kind::brake_on;
    log::warn("haply: " + event->text);
  }

  const DeviceConnection config_;
  const Mat3 unsensed_;
  HaplyReader reader_;
  net::WebSocketClient client_, events_;
  std::string message_;
  bool braked_ = false, grip_lost_ = false;
  int64_t last_grip_ns_ = 0;  ///< when the grip was last told of
  int useless_ = 0;
  uint64_t turns_ = 0;
};

}  // namespace

std::unique_ptr<Servo> make_haply_servo(const DeviceSetup& setup, const DeviceTraits&) {
  return std::make_unique<HaplyServo>(setup);
}

std::string haply_fault(const DeviceSetup& setup) {
  try {
    HaplyServo(setup).find(probing);
    return "";
  } catch (const Error& e) {
    return e.what();
  }
}

}  // namespace ream::device
