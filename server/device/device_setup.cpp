#include "device/device_setup.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/json.hpp"
#include "core/json_reader.hpp"
#include "device/profiles.hpp"

namespace ream::device {
namespace {

constexpr const char* vector_word = "vector";
constexpr const char* values_word = "values";
constexpr const char* button_word = "button";
constexpr const char* always_word = "always";

/// Whether the key says `other` rather than `fallback`.
bool is_alternative(JsonReader& reader, const std::string& key, const std::string& fallback,
                    const std::string& other) {
  const std::string value = reader.text_or(key, fallback);
  if (value != fallback && value != other)
    reader.refuse(key, "is '" + value + "', must be " + fallback + " or " + other);
  return value == other;
}

constexpr double min_motion_mm = 10.0;
/// Two motions that are closer to each other, or to each other's opposite, than 60 degrees tell no axes.
constexpr double max_cosine = 0.5;
constexpr double rotation_tolerance = 1e-6;

/// A planned axis this near to the body's leaves no direction up; cosine.
constexpr double along_the_body = 0.99;
const Vec3 superior = Vec3::UnitZ(), anterior = -Vec3::UnitY();  // the world is LPS

constexpr std::array<const char*, 3> person_axes{"right", "up", "towards"};
constexpr std::array<const char*, 3> tool_axes{"x", "y", "z"};

[[noreturn]] void refuse(const std::string& text) { throw Error(ErrorKind::invalid_input, text); }

Vec3 direction_of(const Vec3& motion_mm, const std::string& name) {
  const double length_mm = motion_mm.norm();
  if (!std::isfinite(length_mm)) refuse("the motion " + name + " is not a number");
  if (length_mm < min_motion_mm)
    refuse("the motion " + name + " was only " + std::to_string(std::lround(length_mm)) +
           " mm long; move the handle at least 10 mm, better 50");
  return motion_mm / length_mm;
}

void require_apart(const Vec3& a, const Vec3& b, const std::string& names) {
  if (std::abs(a.dot(b)) > max_cosine)
    refuse("the motions " + names + " went almost the same way; move straight, and square to the one before");
}

/// The rotation whose rows have these names. `key` of the reader.
Mat3 rotation_of(JsonReader& reader, const std::string& key, const std::array<const char*, 3>& names) {
  JsonReader rows = reader.object(key);
  Mat3 rotation;
  for (int row = 0; row < 3; ++row) {
    const std::vector<double> numbers = rows.numbers(names[static_cast<size_t>(row)], 3);
    rotation.row(row) = Vec3(numbers[0], numbers[1], numbers[2]);
  }
  rows.finish();
  if (!((rotation * rotation.transpose() - Mat3::Identity()).norm() < rotation_tolerance) ||
      rotation.determinant() < 0.0)
    reader.refuse(key,
                  "must be a rotation: three directions of length 1, square to each other, right-handed");
  return rotation;
}

nlohmann::json named_rows(const Mat3& rotation, const std::array<const char*, 3>& names) {
  nlohmann::json json;
  for (int row = 0; row < 3; ++row)
    json[names[static_cast<size_t>(row)]] = {rotation(row, 0), rotation(row, 1), rotation(row, 2)};
  return json;
}

/// "-y" and the like; all zero for anything else.
Vec3 axis_from_word(std::string word) {
  const double sign = word.starts_with('-') ? -1.0 : 1.0;
  if (word.starts_with('-') || word.starts_with('+')) word.erase(0, 1);
  if (word.size() != 1 || word[0] < 'x' || word[0] > 'z') return Vec3::Zero();
  return sign * Vec3::Unit(word[0] - 'x');
}

/// As DeviceSetup says: away from the person, of somebody who holds the handle towards them.
const Mat3 person_from_tool = Vec3(1.0, -1.0, -1.0).asDiagonal();

}  // namespace

DeviceConnection read_device_connection(JsonReader reader) {
  DeviceConnection c;
  c.host = reader.text_or("host", c.host);
  if (c.host.empty()) reader.refuse("host", "must not be empty");
  c.port = static_cast<uint16_t>(reader.integer_or("port", c.port, 1, UINT16_MAX));
  c.events_port = static_cast<uint16_t>(reader.integer_or("events_port", c.events_port, 0, UINT16_MAX));
  c.force_form = is_alternative(reader, "force_form", vector_word, values_word) ? HaplyForceForm::values
                                                                                : HaplyForceForm::vector;
  c.device_id = reader.text_or("device_id", c.device_id);
  c.grip_id = reader.text_or("grip_id", c.grip_id);
  c.library = reader.text_or("library", c.library);
  c.spindle_by_button = !is_alternative(reader, "spindle", button_word, always_word);
  reader.finish();
  return c;
}

nlohmann::json to_json(const DeviceConnection& c) {
  const DeviceConnection fallback;
  nlohmann::json json = nlohmann::json::object();
  if (c.host != fallback.host) json["host"] = c.host;
  if (c.port != fallback.port) json["port"] = c.port;
  if (c.events_port != fallback.events_port) json["events_port"] = c.events_port;
  if (c.force_form != fallback.force_form) json["force_form"] = values_word;
  if (!c.device_id.empty()) json["device_id"] = c.device_id;
  if (!c.grip_id.empty()) json["grip_id"] = c.grip_id;
  if (!c.library.empty()) json["library"] = c.library;
  if (!c.spindle_by_button) json["spindle"] = always_word;
  return json;
}

const char* to_text(Hand hand) noexcept { return hand == Hand::left ? "left" : "right"; }

Mat3 handle_from_tool(const DeviceSetup& setup) {
  const Mat3 mirror = Vec3(-1.0, 1.0, 1.0).asDiagonal();
  return setup.hand == Hand::left ? Mat3(mirror * setup.handle_from_tool * mirror) : setup.handle_from_tool;
}

DeviceSetup default_device_setup(const std::string& device) {
  DeviceSetup setup;
  setup.person_from_device = person_from_axes(device_axes(device));
  setup.handle_from_tool = setup.person_from_device.transpose() * person_from_tool;
  return setup;
}

Mat3 unsensed_rotation(const DeviceSetup& setup) {
  return setup.person_from_device.transpose() * person_from_tool * handle_from_tool(setup).transpose();
}

Mat3 person_from_motions(const Vec3& right_mm, const Vec3& up_mm, const Vec3& towards_mm) {
  const Vec3 right = direction_of(right_mm, "to the right"), up = direction_of(up_mm, "up"),
             towards = direction_of(towards_mm, "towards you");
  require_apart(right, up, "to the right and up");
  require_apart(up, towards, "up and towards you");
  require_apart(towards, right, "towards you and to the right");
  Mat3 device_from_person;
  device_from_person << right, up, towards;
  if (device_from_person.determinant() <= 0.0)
    refuse(
        "the three motions are mirrored; one of them went the wrong way, so start again: right, up, towards "
        "you");
  // The nearest rotation to a matrix is U V^T of its singular value decomposition (Kabsch 1976).
  const Eigen::JacobiSVD<Mat3> svd(device_from_person, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return (svd.matrixU() * svd.matrixV().transpose()).transpose();
}

Mat3 person_from_axes(const std::string& text) {
  Mat3 person_from_device;
  size_t begin = 0;
  for (int row = 0; row < 3; ++row) {
    const size_t end = row < 2 ? text.find(',', begin) : text.size();
    if (end == std::string::npos || begin > end) break;
    person_from_device.row(row) = axis_from_word(text.substr(begin, end - begin));
    begin = end + 1;
    if (row == 2 && person_from_device.determinant() > 0.5) return person_from_device;
  }
  refuse("axes '" + text +
         "' must name the device's axes that go to your right, up and towards you, right-handed, as in "
         "x,y,z or -y,z,-x");
}

Mat3 world_from_person(const Vec3& axis_direction) {
  const Vec3 towards = -axis_direction.normalized();
  const Vec3 up_hint = std::abs(towards.dot(superior)) < along_the_body ? superior : anterior;
  const Vec3 up = (up_hint - towards * towards.dot(up_hint)).normalized();
  Mat3 rotation;
  rotation << up.cross(towards), up, towards;
  return rotation;
}

DeviceSetup parse_device_setup(const nlohmann::json& json, const std::string& place) {
  JsonReader reader(json, place);
  DeviceSetup setup;
  setup.person_from_device = rotation_of(reader, "axes", person_axes);
  setup.scale = reader.number("scale", DeviceSetup::min_scale, DeviceSetup::max_scale);
  const std::string hand = reader.text("hand");
  if (hand != "left" && hand != "right") reader.refuse("hand", "is '" + hand + "', must be left or right");
  setup.hand = hand == "left" ? Hand::left : Hand::right;
  if (reader.has("grip")) setup.handle_from_tool = rotation_of(reader, "grip", tool_axes).transpose();
  if (reader.has("connection")) setup.connection = read_device_connection(reader.object("connection"));
  reader.finish();
  return setup;
}

nlohmann::json to_json(const DeviceSetup& setup) {
  nlohmann::json json = {{"axes", named_rows(setup.person_from_device, person_axes)},
                         {"scale", setup.scale},
                         {"hand", to_text(setup.hand)},
                         {"grip", named_rows(setup.handle_from_tool.transpose(), tool_axes)}};
  if (setup.connection != DeviceConnection{}) json["connection"] = to_json(setup.connection);
  return json;
}

std::filesystem::path device_setup_path(const std::filesystem::path& data, const std::string& device) {
  return data / "devices" / (device + ".json");
}

DeviceSetup load_device_setup(const std::filesystem::path& data, const std::string& device) {
  const std::filesystem::path path = device_setup_path(data, device);
  if (!std::filesystem::exists(path)) return default_device_setup(device);
  return parse_device_setup(read_json_file(path), path.string());
}

void save_device_setup(const std::filesystem::path& data, const std::string& device,
                       const DeviceSetup& setup) {
  const std::filesystem::path path = device_setup_path(data, device);
  make_writable_folder(path.parent_path());
  write_json_file(path, to_json(setup));
}

}  // namespace ream::device
