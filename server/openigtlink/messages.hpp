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

// OpenIGTLink and 3D Slicer have RAS: x to the patient's right, y to the front, z to the head; our world is
// LPS. Between them lies half a turn about z, so directions keep their handedness and rotations stay
// rotations. Both in mm.

/// Coordinates of the world, LPS, to RAS.
const Pose& ras_from_world();

/// Where something with a frame of its own (the tool) is.
Pose ras_from(const Pose& world_from_thing);

/// How something given in RAS has moved, of how it has moved in the world.
Pose moved_in_ras(const Pose& world_from_rest);

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
Message status_message(const Label& label, StatusCode code, const std::string& name, const std::string& text);

}  // namespace ream::openigtlink
