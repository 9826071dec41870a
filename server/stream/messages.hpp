#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "stream/codec.hpp"
#include "stream/telemetry.hpp"
#include "voxel/voxel_grid.hpp"

namespace ream::stream {

/// Changes whenever an old viewer could misread a message.
inline constexpr uint32_t protocol_revision = 1;

/// One binary WebSocket message: a finished ServerMessage of proto/stream.fbs, shared by all viewers.
using Message = std::shared_ptr<const std::vector<std::byte>>;

/// First message of every connection; fields as Hello of proto/stream.fbs.
struct HelloInfo {
  std::string session_id;
  uint64_t server_epoch = 0;  ///< differs after each start of the server
  std::string case_id, case_name;
  std::string side;  ///< "left" or "right"
  voxel::VoxelGrid grid;
  TriangleMesh tool;  ///< cutting envelope, tool frame
  std::string tool_name;
  Vec3 axis_entry_mm = Vec3::Zero(), axis_direction = Vec3::UnitX();  ///< world frame
  double planned_depth_mm = 0;
  double force_scale = 1;       ///< simulated N per hand N
  double force_max_n = 0;       ///< hand N that the device may render
  std::string replay_of;        ///< session that was recorded; empty: this is live
  uint32_t duration_ticks = 0;  ///< of the recording
  /// Of the scapula, world frame; none where the case lacks one of them.
  struct ScapulaPoints {
    Vec3 glenoid_centre_mm, trigonum_mm, inferior_angle_mm;
  };
  std::optional<ScapulaPoints> scapula;
};

Message hello_message(const HelloInfo& info);

/// Another tool is in the hand; for viewers who had their hello.
Message tool_message(const TriangleMesh& tool, const std::string& tool_name);

/// `key_complete`: this ends the first whole picture of a late joiner.
Message mesh_message(std::span<const SharedBlock> blocks, bool key_complete);

/// Newest values are those of the batch's last sample; `dropped` counts what this viewer has lost so far.
Message telemetry_message(const TelemetryBatch& batch, uint32_t dropped);

}  // namespace ream::stream
