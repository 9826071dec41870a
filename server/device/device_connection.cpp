#include "device/device_connection.hpp"

#include "core/json.hpp"

namespace ream::device {
namespace {

constexpr const char* vector_word = "vector";
constexpr const char* values_word = "values";
constexpr const char* button_word = "button";
constexpr const char* always_word = "always";

/// Whether the key says `other` rather than `usual`.
bool is_other(JsonReader& reader, const std::string& key, const std::string& usual,
              const std::string& other) {
  const std::string said = reader.text_or(key, usual);
  if (said != usual && said != other)
    reader.refuse(key, "is '" + said + "', must be " + usual + " or " + other);
  return said == other;
}

}  // namespace

DeviceConnection read_device_connection(JsonReader reader) {
  DeviceConnection c;
  c.host = reader.text_or("host", c.host);
  if (c.host.empty()) reader.refuse("host", "must not be empty");
  c.port = static_cast<uint16_t>(reader.integer_or("port", c.port, 1, UINT16_MAX));
  c.events_port = static_cast<uint16_t>(reader.integer_or("events_port", c.events_port, 0, UINT16_MAX));
  c.force_form = is_other(reader, "force_form", vector_word, values_word) ? HaplyForceForm::values
                                                                          : HaplyForceForm::vector;
  c.device_id = reader.text_or("device_id", c.device_id);
  c.grip_id = reader.text_or("grip_id", c.grip_id);
  c.library = reader.text_or("library", c.library);
  c.spindle_by_button = !is_other(reader, "spindle", button_word, always_word);
  reader.finish();
  return c;
}

nlohmann::json to_json(const DeviceConnection& c) {
  const DeviceConnection usual;
  nlohmann::json json = nlohmann::json::object();
  if (c.host != usual.host) json["host"] = c.host;
  if (c.port != usual.port) json["port"] = c.port;
  if (c.events_port != usual.events_port) json["events_port"] = c.events_port;
  if (c.force_form != usual.force_form) json["force_form"] = values_word;
  if (!c.device_id.empty()) json["device_id"] = c.device_id;
  if (!c.grip_id.empty()) json["grip_id"] = c.grip_id;
  if (!c.library.empty()) json["library"] = c.library;
  if (!c.spindle_by_button) json["spindle"] = always_word;
  return json;
}

}  // namespace ream::device
