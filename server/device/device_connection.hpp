#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/json_reader.hpp"

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

}  // namespace ream::device
