#pragma once
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/json_reader.hpp"
#include "geometry/pose.hpp"

namespace ream::device {

/// How the force is written into a message to Haply's service: "vector" since its version 3.5, "values"
/// before.
enum class HaplyForceForm { vector, values };

/// Where a device is and how it is spoken to: `connection` in devices/NAME.json. Each kind of device uses
/// what concerns it; empty texts: the first or usual one.
struct DeviceConnection {
  std::string host = "127.0.0.1";  ///< haply: of the service
  uint16_t port = 10001;           ///< haply: of the service's simulation channel
  uint16_t events_port = 10020;    ///< haply: of its events; 0: they are not listened to
  HaplyForceForm force_form = HaplyForceForm::vector;
  std::string device_id;  ///< haply: as "049D"; forcedimension: number, from 0; openhaptics: configured name
  std::string grip_id;    ///< haply: of the grip
  std::string library;    ///< forcedimension, openhaptics: path of the maker's library
  bool spindle_by_button = true;  ///< false: the spindle always turns, of handles without a button

  bool operator==(const DeviceConnection&) const = default;
};

/// Reads it and refuses unknown keys; what is not said is as above.
DeviceConnection read_device_connection(JsonReader reader);
/// What differs from the above.
nlohmann::json to_json(const DeviceConnection& connection);

/// Which hand holds the tool.
enum class Hand { right, left };
const char* to_text(Hand hand) noexcept;

/// How a haptic device stands in front of a person and how the tool lies in the hand. The person's frame: x
/// to the right, y up, z towards the person.
struct DeviceSetup {
  Mat3 person_from_device = Mat3::Identity();  ///< a rotation
  /// World mm for each mm of the device. Forces stay hand newtons, as they are recorded and shown; lengths in
  /// the hand are shorter by the scale, and torques with them. So all work is smaller by one and the same
  /// factor, and what is passive in the world is passive in the hand.
  double scale = 1.0;
  Hand hand = Hand::right;
  /// How the tool lies in a right hand: its axes in the handle's, which are the device's when the device
  /// reports no turn. As it is here, a handle without a turn points the tool away from the person.
  Mat3 handle_from_tool = Vec3(1.0, -1.0, -1.0).asDiagonal();

  DeviceConnection connection;

  static constexpr double min_scale = 0.05, max_scale = 20.0;
};

/// The set-up that a kind of device is made with: its maker's frame, as it stands before a person, and a
/// handle whose neutral place points the tool away from the person.
DeviceSetup default_device_setup(const std::string& device);

/// The orientation to be told of a handle that senses none (device frame), so that the tool keeps the planned
/// axis.
Mat3 unsensed_rotation(const DeviceSetup& setup);

/// How the tool lies in the hand that holds it: in a left one mirrored, left for right.
Mat3 handle_from_tool(const DeviceSetup& setup);

/// Set-up of the device from its motions (device frame, mm) while a person moved the handle to the right, up,
/// and towards themselves: the rotation that turns them nearest to x, y and z. Errors, invalid_input: a
/// motion shorter than 10 mm; two less than 60 degrees apart; the three are mirrored.
Mat3 person_from_motions(const Vec3& right_mm, const Vec3& up_mm, const Vec3& towards_mm);

/// Axes as people write them, "X,Y,Z": for the person's right, up and towards, the device's axis that goes
/// there, as in "x,y,z" or "-y,z,-x". Error invalid_input.
Mat3 person_from_axes(const std::string& axes);

/// The rotation that takes the person's coordinates to the world's, for a planned axis (into the bone, world,
/// any length but 0): it goes away from the person, and up is towards the patient's head as far as possible,
/// as for one who sits upright; where the axis is along the body, up is to the front.
Mat3 world_from_person(const Vec3& axis_direction);

/// As in data/devices/NAME.json; see proto/device-setup.schema.json. `place` names the file in errors, which
/// are invalid_input.
DeviceSetup parse_device_setup(const nlohmann::json& json, const std::string& place);
nlohmann::json to_json(const DeviceSetup& setup);

/// Where the set-up of a device is kept, and what is kept there: without a file its usual one.
std::filesystem::path device_setup_path(const std::filesystem::path& data, const std::string& device);
DeviceSetup load_device_setup(const std::filesystem::path& data, const std::string& device);
/// All of it or nothing. Error io.
void save_device_setup(const std::filesystem::path& data, const std::string& device,
                       const DeviceSetup& setup);

}  // namespace ream::device
