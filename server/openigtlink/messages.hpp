#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "geometry/pose.hpp"
#include "geometry/triangle_mesh.hpp"

namespace ream::openigtlink {

/// One whole message: header of version 1 and body, as it goes over the wire. Shared by all clients.
using Message = std::shared_ptr<const std::vector<std::byte>>;

/// Who a message is about, and when: nanoseconds since 1970, UTC.
struct Label {
  std::string name;  ///< 20 characters at most count
  int64_t unix_ns = 0;
};

enum class SensorUnit { newton, newton_metre };

/// Codes of STATUS that are used here.
enum class StatusCode : uint16_t { ok = 1, not_ready = 13, hardware_failure = 18, shut_down = 19 };

/// TRANSFORM: coordinates in the thing's frame, mm, to RAS.
Message transform_message(const Label& label, const Pose& ras_from_thing);

/// POLYDATA: triangles with their normals, where there are any, in coordinates of the receiver, mm. Error
/// invalid_input for more bytes than the protocol's fields can count.
Message polydata_message(const Label& label, const TriangleMesh& mesh);

/// SENSOR: up to 255 values of one unit.
Message sensor_message(const Label& label, std::span<const double> values, SensorUnit unit);

/// STRING, UTF-8; 65535 bytes at most count.
Message string_message(const Label& label, const std::string& text);

/// STATUS; `name` has 20 characters at most.
Message status_message(const Label& label, StatusCode code, const std::string& name,
                       const std::string& words);

}  // namespace ream::openigtlink
