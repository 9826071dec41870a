#pragma once
#include <string>
#include <string_view>

#include "device/device_setup.hpp"
#include "geometry/pose.hpp"

namespace ream::device {

/// The name under which Haply's service keeps what people configure for this program.
inline constexpr const char* haply_profile = "ream.simulator:main";

/// What a message says beside its force: nothing; the session's configuration, as the first message of a
/// connection must; or that everything is to be told anew, configurations of devices among it.
enum class HaplyRequest { nothing, configure, full_state };

/// One message to the service (docs.haply.co, WebSocket protocol 3.5): the force on one Inverse3, N, its
/// frame. Written into `text`. Forces are rounded to a micronewton.
void write_haply_message(std::string& text, const std::string& device_id, const Vec3& force_n,
                         HaplyForceForm form, HaplyRequest command);

/// What the service has said of one Inverse3 and its grip; what a frame leaves out keeps its last value.
struct HaplyDevice {
  std::string device_id, grip_id;
  Vec3 position_m = Vec3::Zero();
  std::array<double, 4> orientation_wxyz{1, 0, 0, 0};
  bool has_position = false, has_grip = false, has_buttons = false;
  bool button_a = false, button_b = false, button_c = false;
  bool grip_connected = true;  ///< as it was last said
  bool grip_reported = false;  ///< the newest frame tells of the grip, and it is connected
  double force_scale = 1.0;    ///< what the service multiplies forces with
};

/// Follows one Inverse3 and one grip through the frames of a connection.
class HaplyReader {
 public:
  /// Ids as in DeviceConnection: empty takes the first of the inventory.
  HaplyReader(std::string device_id, std::string grip_id);

  /// The first frame of a connection. Error unavailable, naming what there is, when the Inverse3 is not
  /// there; invalid_input when it is no inventory.
  void take_inventory(std::string_view text);
  /// Any later frame. False: it could not be read, or does not tell of this Inverse3 and where it is (`why`
  /// says which), and nothing has changed.
  bool take_state(std::string_view text, std::string& why);
  /// Buttons of a grip that has gone are pressed no longer.
  void release_buttons() { device_.button_a = device_.button_b = device_.button_c = false; }

  const HaplyDevice& device() const { return device_; }

 private:
  const std::string configured_id_, configured_grip_;
  HaplyDevice device_;
};

/// What an event of the service (port 10020) means for a session with this Inverse3.
struct HaplyEvent {
  enum class Kind { nothing, brake_on, brake_off, warning, gone } kind = Kind::nothing;
  std::string text;  ///< for people
};
HaplyEvent read_haply_event(std::string_view text, const std::string& device_id);

}  // namespace ream::device
