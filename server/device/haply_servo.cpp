#include "device/haply_servo.hpp"

#include "core/error.hpp"
#include "core/log.hpp"
#include "device/haply_messages.hpp"
#include "net/websocket_client.hpp"

namespace ream::device {
namespace {

using namespace std::chrono_literals;

constexpr auto connecting = 1000ms, sending = 250ms, answering = 250ms, looking = 500ms;
constexpr double mm_per_m = 1000.0;
/// So many useless frames one after the other, and the connection is begun anew.
constexpr int useless_frames_allowed = 100;
constexpr int turns_between_events = 10;

const std::string start_service =
    "; start Haply's Inverse Service (`systemctl start haply-inverse-service`), or correct host and port in "
    "the "
    "set-up";

/// The service with one device of it.
class HaplyServo final : public Servo {
 public:
  explicit HaplyServo(const DeviceSetup& setup)
      : wanted_(setup.connection),
        unsensed_(unsensed_rotation(setup)),
        reader_(wanted_.device_id, wanted_.grip_id) {}

  void open(ServoEnd& end) override {
    find(connecting);
    listen_to_events();
    braked_ = false;
    useless_ = 0;
    exchange(Vec3::Zero(), true);
    const int64_t sent_ns = end.now_ns();
    exchange(Vec3::Zero(), false);
    if (!reader_.device().has_position)
      throw Error(ErrorKind::unavailable, service() + " tells no position of its Inverse3");
    end.tell(state(), sent_ns);
  }

  /// Connects and takes the inventory.
  void find(std::chrono::milliseconds most) {
    try {
      client_.connect(wanted_.host, wanted_.port, "/", most);
    } catch (const Error& e) {
      throw Error(ErrorKind::unavailable, std::string("Haply's service at ") + e.what() + start_service);
    }
    try {
      const auto inventory = client_.receive(most);
      if (!inventory) throw Error(ErrorKind::unavailable, "it sent no inventory of devices");
      reader_.take_inventory(*inventory);
    } catch (const Error& e) {
      throw Error(ErrorKind::unavailable, service() + ": " + e.what());
    }
  }

  void turn(ServoEnd& end) override {
    const ServoForce wanted = end.force();
    const int64_t sent_ns = end.now_ns();
    if (exchange(wanted.force_n, false)) end.tell(state(), sent_ns);
    if (++turns_ % turns_between_events == 0) hear_events();
  }

  void close() noexcept override {
    try {
      if (client_.is_open() && !reader_.device().device_id.empty()) {
        write_haply_message(message_, reader_.device().device_id, Vec3::Zero(), wanted_.force_form, false);
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
    return "Haply's service at " + wanted_.host + ":" + std::to_string(wanted_.port);
  }

  /// One message and the one frame that answers it. False: the frame is of no use.
  bool exchange(const Vec3& force_n, bool first) {
    const HaplyDevice& device = reader_.device();
    // What the service scales up is sent smaller; where it scales down, no more than the device's limit.
    write_haply_message(message_, device.device_id, force_n / std::max(1.0, device.force_scale),
                        wanted_.force_form, first);
    try {
      client_.send(message_, sending);
      const auto frame = client_.receive(answering);
      if (!frame) throw Error(ErrorKind::unavailable, "it has not answered for a quarter of a second");
      std::string why;
      if (reader_.take_state(*frame, why)) {
        useless_ = 0;
        return true;
      }
      if (++useless_ > useless_frames_allowed) throw Error(ErrorKind::unavailable, why);
    } catch (const Error& e) {
      throw Error(ErrorKind::unavailable, service() + ": " + e.what());
    }
    return false;
  }

  ServoState state() const {
    const HaplyDevice& device = reader_.device();
    ServoState state;
    state.device_from_handle = {
        device.has_grip ? rotation_from_quaternion(device.orientation_wxyz) : unsensed_,
        mm_per_m * device.position_m};
    state.spindle_on = wanted_.spindle_by_button && device.has_buttons ? device.button_a : true;
    state.clutch = device.button_b;
    state.paused = device.button_c || braked_;
    return state;
  }

  void listen_to_events() {
    if (wanted_.events_port == 0) return;
    try {
      events_.connect(wanted_.host, wanted_.events_port, "/", looking);
    } catch (const Error& e) {
      log::info(std::string("haply: without its safety events: ") + e.what());
    }
  }

  void hear_events() {
    if (!events_.is_open()) return;
    std::optional<HaplyEvent> heard;
    try {
      if (const auto text = events_.receive(0ms)) heard = read_haply_event(*text, reader_.device().device_id);
    } catch (const Error& e) {
      log::warn(std::string("haply: its safety events ended: ") + e.what());
    }
    if (!heard || heard->kind == HaplyEvent::Kind::nothing) return;
    if (heard->kind == HaplyEvent::Kind::gone) throw Error(ErrorKind::unavailable, heard->words);
    if (heard->kind != HaplyEvent::Kind::warning) braked_ = heard->kind == HaplyEvent::Kind::brake_on;
    log::warn("haply: " + heard->words);
  }

  const DeviceConnection wanted_;
  const Mat3 unsensed_;
  HaplyReader reader_;
  net::WebSocketClient client_, events_;
  std::string message_;
  bool braked_ = false;
  int useless_ = 0;
  uint64_t turns_ = 0;
};

}  // namespace

std::unique_ptr<Servo> make_haply_servo(const DeviceSetup& setup, const DeviceTraits&) {
  return std::make_unique<HaplyServo>(setup);
}

std::string why_no_haply(const DeviceSetup& setup) {
  try {
    HaplyServo(setup).find(looking);
    return "";
  } catch (const Error& e) {
    return e.what();
  }
}

}  // namespace ream::device
