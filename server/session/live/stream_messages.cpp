#include "session/live/stream_messages.hpp"

#include "case/two_plates.hpp"

namespace ream::session {
namespace {

bool is_at_rest(const Pose& world_from_bone_rest) {
  return world_from_bone_rest.rotation == Mat3::Identity() &&
         world_from_bone_rest.translation_mm == Vec3::Zero();
}

}  // namespace

stream::HelloInfo make_hello(const case_::Case& c, const case_::Plan& plan, const shell::Tool& tool,
                             const case_::Anatomy& anatomy) {
  stream::HelloInfo info;
  info.case_id = case_::is_two_plates(c.id) ? case_::two_plates_word : c.id;
  info.case_name = c.name;
  info.side = case_::to_text(c.side);
  info.grid = c.bone.grid;
  info.tool = tool.mesh;
  info.tool_name = tool.name;
  info.axis_entry_mm = plan.entry_mm;
  info.axis_direction = plan.axis_direction;
  info.planned_depth_mm = plan.depth_mm;
  if (const auto& points = anatomy.landmarks;
      points && points->glenoid_centre_mm && points->trigonum_mm && points->inferior_angle_mm)
    info.scapula = {*points->glenoid_centre_mm, *points->trigonum_mm, *points->inferior_angle_mm};
  return info;
}

void update_sample(const record::TickReport& r, stream::TelemetrySample& sample) {
  sample.tick = r.tick;
  sample.thrust_n = static_cast<float>(r.thrust_n);
  sample.hand_force_n = static_cast<float>(r.hand_force_n.norm());
  sample.torque_n_mm = static_cast<float>(r.torque_n_mm);
  sample.feed_rate_mm_s = static_cast<float>(r.feed_rate_mm_s);
  sample.density_g_cc = static_cast<float>(r.density_g_cc);
  sample.vibration_g = static_cast<float>(r.vibration_g);
  sample.world_from_tool = r.world_from_tool;
  sample.world_from_handle = r.world_from_handle;
  sample.world_from_bone_rest.reset();
  if (!is_at_rest(r.world_from_bone_rest)) sample.world_from_bone_rest = r.world_from_bone_rest;
  sample.spindle_on = r.spindle_on;
  sample.spindle_speed_rad_s = static_cast<float>(r.spindle_speed_rad_s);
  sample.surface_temperature_c = static_cast<float>(r.surface_temperature_c);
  sample.irrigating = r.drive.irrigating;
  sample.stalled = r.stalled;
  sample.cortical_share = static_cast<float>(r.share[static_cast<size_t>(voxel::BoneClass::cortical)]);
}

void hide_material(stream::TelemetrySample& sample) { sample.density_g_cc = sample.cortical_share = 0.0f; }

void update_sample(const score::MetricsAccumulator& metrics, double depth_mm, const sim::LoopHealth& health,
                   stream::TelemetrySample& sample) {
  sample.depth_mm = static_cast<float>(depth_mm);
  sample.removed_volume_mm3 = static_cast<float>(metrics.removed_volume_mm3());
  sample.tick_mean_us = static_cast<float>(health.tick_us.mean_us);
  sample.tick_p99_us = static_cast<float>(health.tick_us.p99_us);
  sample.ticks_missed = static_cast<uint32_t>(health.missed);
}

}  // namespace ream::session
