#include "stream/messages.hpp"

#include <array>
#include <cstring>

#include "stream_generated.h"

namespace ream::stream {
namespace {

using flatbuffers::FlatBufferBuilder;

wire::Vec3 to_wire(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

wire::Pose to_wire(const Pose& pose) {
  const std::array<double, 4> q = quaternion_from_rotation(pose.rotation);
  return {wire::Quat(static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2]),
                     static_cast<float>(q[3])),
          to_wire(pose.translation_mm)};
}

template <typename Table>
Message finished(FlatBufferBuilder& builder, wire::Body kind, flatbuffers::Offset<Table> body) {
  builder.Finish(wire::CreateServerMessage(builder, kind, body.Union()));
  const auto* begin = reinterpret_cast<const std::byte*>(builder.GetBufferPointer());
  return std::make_shared<const std::vector<std::byte>>(begin, begin + builder.GetSize());
}

flatbuffers::Offset<flatbuffers::Vector<uint8_t>> aligned_bytes(FlatBufferBuilder& builder,
                                                                const std::vector<std::byte>& bytes) {
  builder.ForceVectorAlignment(bytes.size(), 1, 8);
  return builder.CreateVector(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
}

template <typename Field>
flatbuffers::Offset<flatbuffers::Vector<float>> column(FlatBufferBuilder& builder,
                                                       const TelemetryBatch& batch, Field field) {
  return builder.CreateVector<float>(batch.samples.size(), [&](size_t i) { return batch.samples[i].*field; });
}

/// A mesh as the wire has it: three floats a vertex, three indices a triangle.
struct FlatMesh {
  std::vector<float> positions;
  std::vector<uint32_t> indices;

  explicit FlatMesh(const TriangleMesh& mesh) {
    for (const Vec3f& p : mesh.vertices_mm) positions.insert(positions.end(), {p.x(), p.y(), p.z()});
    for (const auto& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
  }
};

}  // namespace

Message hello_message(const HelloInfo& info) {
  FlatBufferBuilder builder;
  const FlatMesh tool(info.tool);
  const Vec3i& dims = info.grid.dims;
  const wire::Vec3 spacing = to_wire(info.grid.spacing_mm), entry = to_wire(info.axis_entry_mm),
                   direction = to_wire(info.axis_direction);
  const wire::Pose world_from_grid = to_wire(info.grid.world_from_grid);
  std::array<wire::Vec3, 3> scapula;
  std::array<const wire::Vec3*, 3> points{};
  if (info.scapula) {
    scapula = {to_wire(info.scapula->glenoid_centre_mm), to_wire(info.scapula->trigonum_mm),
               to_wire(info.scapula->inferior_angle_mm)};
    points = {&scapula[0], &scapula[1], &scapula[2]};
  }
  const auto hello = wire::CreateHello(
      builder, protocol_revision, builder.CreateString(info.session_id), info.server_epoch,
      builder.CreateString(info.case_id), builder.CreateString(info.case_name),
      builder.CreateString(info.side),
      builder.CreateVector(std::vector<int32_t>{dims.x(), dims.y(), dims.z()}), &spacing, &world_from_grid,
      surface::block_edge, builder.CreateVector(tool.positions), builder.CreateVector(tool.indices),
      builder.CreateString(info.tool_name), &entry, &direction, static_cast<float>(info.planned_depth_mm),
      static_cast<float>(info.force_scale), static_cast<float>(info.force_max_n),
      info.replay_of.empty() ? 0 : builder.CreateString(info.replay_of), info.duration_ticks, points[0],
      points[1], points[2]);
  return finished(builder, wire::Body::Hello, hello);
}

Message tool_message(const TriangleMesh& mesh, const std::string& tool_name) {
  FlatBufferBuilder builder;
  const FlatMesh tool(mesh);
  const auto change =
      wire::CreateToolChange(builder, builder.CreateVector(tool.positions),
                             builder.CreateVector(tool.indices), builder.CreateString(tool_name));
  return finished(builder, wire::Body::ToolChange, change);
}

Message mesh_message(std::span<const SharedBlock> blocks, bool key_complete) {
  size_t bytes = 1024;
  for (const SharedBlock& block : blocks) bytes += block->bytes() + 112;
  FlatBufferBuilder builder(bytes);
  std::vector<flatbuffers::Offset<wire::MeshBlock>> tables;
  for (const SharedBlock& block : blocks) {
    const auto vertices = aligned_bytes(builder, block->vertices);
    const auto indices = aligned_bytes(builder, block->indices);
    const auto classes = builder.CreateVector(block->classes);
    const auto removed = block->removed.empty() ? 0 : builder.CreateVector(block->removed);
    const auto densities = block->densities.empty() ? 0 : builder.CreateVector(block->densities);
    tables.push_back(wire::CreateMeshBlock(builder, block->block, block->revision, block->tick,
                                           block->vertex_count, block->index_count, vertices, indices,
                                           classes, removed, densities));
  }
  const auto list = builder.CreateVector(tables);
  return finished(builder, wire::Body::MeshDelta, wire::CreateMeshDelta(builder, list, key_complete));
}

Message telemetry_message(const TelemetryBatch& batch, uint32_t dropped) {
  FlatBufferBuilder builder(2048 + 24 * batch.samples.size());
  const TelemetrySample& newest = batch.samples.back();
  const wire::Pose tool = to_wire(newest.world_from_tool), handle = to_wire(newest.world_from_handle);
  const wire::Pose bone = to_wire(newest.world_from_bone_rest.value_or(Pose{}));
  flatbuffers::Offset<wire::Playback> playback;
  if (newest.playback)
    playback = wire::CreatePlayback(builder, newest.playback->position_ticks, newest.playback->speed,
                                    newest.playback->playing, newest.playback->jump);
  const size_t fault_length = strnlen(newest.fault.data(), newest.fault.size());
  const auto telemetry = wire::CreateTelemetry(
      builder, batch.samples.front().tick, batch.tick_stride,
      column(builder, batch, &TelemetrySample::thrust_n),
      column(builder, batch, &TelemetrySample::hand_force_n),
      column(builder, batch, &TelemetrySample::torque_n_mm),
      column(builder, batch, &TelemetrySample::feed_rate_mm_s),
      column(builder, batch, &TelemetrySample::density_g_cc), newest.tick, &tool, &handle, newest.spindle_on,
      static_cast<wire::SessionState>(newest.state), newest.depth_mm, newest.removed_volume_mm3,
      newest.cortical_share, dropped, newest.tick_mean_us, newest.tick_p99_us, newest.ticks_missed,
      builder.CreateString(newest.fault.data(), fault_length), newest.world_from_bone_rest ? &bone : nullptr,
      playback, column(builder, batch, &TelemetrySample::vibration_g), static_cast<uint64_t>(batch.stamp_us),
      newest.spindle_speed_rad_s, newest.surface_temperature_c, newest.irrigating, newest.stalled);
  return finished(builder, wire::Body::Telemetry, telemetry);
}

}  // namespace ream::stream
