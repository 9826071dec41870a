#include "device/vendors/haply_messages.hpp"

#include <charconv>
#include <cmath>

#include "core/error.hpp"
#include "core/json.hpp"

namespace ream::device {
namespace {

using nlohmann::json;

/// In the order in which they are preferred.
constexpr std::array grips{"wireless_verse_grip", "custom_verse_grip", "verse_grip"};
constexpr double micro = 1.0e6;
constexpr double max_length_error = 0.01;

void append(std::string& text, double value) {
  const double rounded = std::round(value * micro) / micro + 0.0;
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, rounded).ptr;
  text.append(digits, end);
}

void append_quoted(std::string& text, const std::string& words) { text += json(words).dump(); }

/// Null where it is not an object or has no such member.
const json& member(const json& value, const char* name) {
  static const json none;
  if (!value.is_object()) return none;
  const auto found = value.find(name);
  return found == value.end() ? none : *found;
}

std::string text_of(const json& value, const char* name) {
  const json& found = member(value, name);
  return found.is_string() ? found.get<std::string>() : std::string();
}

/// Of an array of devices the one with this id, or the first; null: none.
const json& device_in(const json& list, const std::string& id) {
  static const json none;
  if (!list.is_array()) return none;
  for (const json& one : list)
    if (!text_of(one, "device_id").empty() && (id.empty() || text_of(one, "device_id") == id)) return one;
  return none;
}

/// A number that is there replaces the last one. False: there is something else in its place.
bool take_number(const json& value, const char* name, double& last) {
  const json& found = member(value, name);
  if (found.is_null()) return member(value, name).is_null() && (!value.is_object() || !value.contains(name));
  if (!found.is_number() || !std::isfinite(found.get<double>())) return false;
  last = found.get<double>();
  return true;
}

bool take_vector(const json& value, Vec3& last) {
  Vec3 v = last;
  if (!take_number(value, "x", v.x()) || !take_number(value, "y", v.y()) || !take_number(value, "z", v.z()))
    return false;
  last = v;
  return true;
}

bool take_turn(const json& value, std::array<double, 4>& last) {
  std::array<double, 4> q = last;
  if (!take_number(value, "w", q[0]) || !take_number(value, "x", q[1]) || !take_number(value, "y", q[2]) ||
      !take_number(value, "z", q[3]))
    return false;
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(std::abs(length - 1.0) <= max_length_error)) return false;
  for (double& part : q) part /= length;
  last = q;
  return true;
}

/// Grips name their buttons a, b, c; other makers' by number; the wired one has one only.
void take_button(const json& buttons, std::initializer_list<const char*> names, HaplyDevice& device,
                 bool& last) {
  for (const char* name : names)
    if (const json& found = member(buttons, name); found.is_boolean()) {
      last = found.get<bool>();
      device.has_buttons = true;
    }
}

/// Of the session's or the device's filters: a number, or an object that holds it.
double force_scale_of(const json& filters) {
  const json& configured = member(filters, "force_scale");
  if (configured.is_number()) return configured.get<double>();
  for (const char* name : {"gain", "scalar", "value"})
    if (const json& number = member(configured, name); number.is_number()) return number.get<double>();
  return 1.0;
}

void take_force_scale(const json& inverse3, HaplyDevice& device) {
  const json& filters = member(member(inverse3, "config"), "filters");
  if (!filters.is_object()) return;
  const double scale = force_scale_of(filters);
  device.force_scale = std::isfinite(scale) && scale > 0.0 ? scale : 1.0;
}

bool take_grip(const json& frame, const std::string& configured, HaplyDevice& device) {
  device.grip_reported = false;
  for (const char* kind : grips) {
    const json& grip = device_in(member(frame, kind), configured.empty() ? device.grip_id : configured);
    if (grip.is_null()) continue;
    const json& state = member(grip, "state");
    if (const json& turn = member(state, "orientation"); !turn.is_null()) {
      if (!take_turn(turn, device.orientation_wxyz)) return false;
      device.has_grip = true;
    }
    device.grip_id = text_of(grip, "device_id");
    if (const json& connected = member(member(grip, "status"), "connected"); connected.is_boolean())
      device.grip_connected = connected.get<bool>();
    device.grip_reported = device.grip_connected;
    const json& buttons = member(state, "buttons");
    take_button(buttons, {"a", "button_1", "button"}, device, device.button_a);
    take_button(state, {"button"}, device, device.button_a);
    take_button(buttons, {"b", "button_2"}, device, device.button_b);
    take_button(buttons, {"c", "button_3"}, device, device.button_c);
    return true;
  }
  return true;
}

/// False when what it says of position or orientation is no number; nothing has changed then.
bool take_frame(const json& frame, const json& inverse3, const std::string& configured_grip,
                HaplyDevice& device) {
  HaplyDevice next = device;
  const json& position = member(member(inverse3, "state"), "cursor_position");
  if (!take_vector(position, next.position_m)) return false;
  next.has_position |= position.is_object();
  if (!take_grip(frame, configured_grip, next)) return false;
  device = next;
  return true;
}

std::string ids_of(const json& list) {
  std::string ids;
  if (list.is_array())
    for (const json& one : list) ids += (ids.empty() ? "" : ", ") + text_of(one, "device_id");
  return ids.empty() ? "none" : ids;
}

}  // namespace

void write_haply_message(std::string& text, const std::string& device_id, const Vec3& force_n,
                         HaplyForceForm form, HaplyRequest command) {
  text.clear();
  text += '{';
  if (command == HaplyRequest::configure) {
    text += R"("session":{"configure":{"profile":{"name":)";
    append_quoted(text, haply_profile);
    text += "}}},";
  }
  if (command == HaplyRequest::full_state) text += R"("session":{"force_render_full_state":{}},)";
  text += R"("inverse3":[{"device_id":)";
  append_quoted(text, device_id);
  text += R"(,"commands":{"set_cursor_force":{)";
  text += form == HaplyForceForm::vector ? R"("vector":{"x":)" : R"("values":{"x":)";
  append(text, force_n.x());
  text += R"(,"y":)";
  append(text, force_n.y());
  text += R"(,"z":)";
  append(text, force_n.z());
  text += "}}}}]}";
}

HaplyReader::HaplyReader(std::string device_id, std::string grip_id)
    : configured_id_(std::move(device_id)), configured_grip_(std::move(grip_id)) {}

void HaplyReader::take_inventory(std::string_view text) {
  const json frame = parse_json_or_discard(text);
  if (!frame.is_object()) throw Error(ErrorKind::unavailable, "its first message is no inventory of devices");
  const json& list = member(frame, "inverse3");
  const json& found = device_in(list, configured_id_);
  if (found.is_null())
    throw Error(ErrorKind::unavailable,
                configured_id_.empty() ? "it has no Inverse3; check the device's cable and power"
                                       : "it has no Inverse3 '" + configured_id_ + "', but " + ids_of(list) +
                                             "; correct device_id in the set-up, or check the cable");
  device_ = {};
  device_.device_id = text_of(found, "device_id");
  take_force_scale(found, device_);
  if (!take_frame(frame, found, configured_grip_, device_))
    throw Error(ErrorKind::unavailable, "its inventory has a position or an orientation that is no number");
  if (!configured_grip_.empty() && device_.grip_id != configured_grip_)
    throw Error(ErrorKind::unavailable,
                "it has no grip '" + configured_grip_ + "'; wake it up, or correct grip_id in the set-up");
}

bool HaplyReader::take_state(std::string_view text, std::string& why) {
  const json frame = parse_json_or_discard(text);
  if (!frame.is_object()) {
    why = "it says something that is no JSON";
    return false;
  }
  const json& found = device_in(member(frame, "inverse3"), device_.device_id);
  if (found.is_null()) {
    why = "it does not tell of Inverse3 '" + device_.device_id + "' any more; check its cable and power";
    return false;
  }
  // Of the position an axis may be left out, as it is where it was; without any it is no news of the pose.
  if (!member(member(found, "state"), "cursor_position").is_object()) {
    why = "it does not tell where Inverse3 '" + device_.device_id + "' is";
    return false;
  }
  if (take_frame(frame, found, configured_grip_, device_)) {
    take_force_scale(found, device_);
    return true;
  }
  why = "it tells of a position or an orientation that is no number";
  return false;
}

HaplyEvent read_haply_event(std::string_view text, const std::string& device_id) {
  using Kind = HaplyEvent::Kind;
  const json event = parse_json_or_discard(text);
  const json& data = member(event, "data");
  const std::string about = text_of(data, "device_id");
  if (!about.empty() && about != device_id) return {};
  const std::string name = text_of(event, "name"), type = text_of(data, "safety_type");
  const std::string words = text_of(event, "message");
  if (name == "device-disconnected" && about == device_id)
    return {Kind::gone, "the Inverse3 was disconnected; check its cable and power"};
  if (name != "device-safety-triggered") return {};
  if (type == "ebrake_triggered") return {Kind::brake_on, "its emergency brake is on: " + words};
  if (type == "ebrake_released") return {Kind::brake_off, "its emergency brake is off: " + words};
  return {Kind::warning, "safety, " + type + ": " + words};
}

}  // namespace ream::device
