#include "score/metrics.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/clock.hpp"
#include "core/hash.hpp"

namespace ream::score {

MetricsAccumulator::MetricsAccumulator(double voxel_volume_mm3, const Pose& plan_from_world)
    : voxel_volume_mm3_(voxel_volume_mm3), plan_from_world_(plan_from_world) {}

void MetricsAccumulator::add(const record::TickReport& r) {
  ++ticks_;
  session_hash_ = r.session_hash;
  weakened_ticks_ += r.weakened ? 1 : 0;
  const Vec3 in_bone_mm = r.world_from_bone_rest.inverse().point(r.world_from_tool.translation_mm);
  const double axial_mm = plan_from_world_.point(in_bone_mm).z();
  if (r.engaged) {
    ++contact_ticks_;
    if (!touched_) first_contact_mm_ = deepest_mm_ = axial_mm;
    touched_ = true;
    if (r.spindle_on) {
      ++cutting_ticks_;
      thrust_sum_n_ += r.thrust_n;
      thrust_peak_n_ = std::max(thrust_peak_n_, r.thrust_n);
    }
  }
  for (size_t k = 0; k < voxel::bone_class_count; ++k) coverage_removed_[k] += r.coverage_removed[k];
  if (touched_ && r.changed_bricks > 0) deepest_mm_ = std::max(deepest_mm_, axial_mm);
  follow_rise(r, axial_mm);
  if (r.engaged && r.spindle_on) thrust_excess_n_s_ += std::max(0.0, r.thrust_n - excess_from_n) * tick_s;
  const Pose bone_from_tool = r.world_from_bone_rest.inverse() * r.world_from_tool;
  cut_axis_.add(plan_from_world_ * bone_from_tool,
                r.coverage_removed[0] + r.coverage_removed[1] + r.coverage_removed[2]);
  breakthrough_.add(r, axial_mm);
  plate_stop_.add(r, axial_mm);
  passes_.add(r);
  path_.add(in_bone_mm, r.engaged, r.paused);
}

void MetricsAccumulator::follow_rise(const record::TickReport& r, double axial_mm) {
  if (risen_) return;
  const bool pressed = r.engaged && r.spindle_on && r.thrust_n >= stiffness_from_n;
  if (pressed && !rising_) {
    rise_thrust_n_ = r.thrust_n;
    rise_mm_ = axial_mm;
  }
  rising_ = pressed;
  if (!pressed || r.thrust_n < stiffness_to_n) return;
  risen_ = true;
  if (axial_mm > rise_mm_) apparent_stiffness_n_mm_ = (r.thrust_n - rise_thrust_n_) / (axial_mm - rise_mm_);
}

Metrics MetricsAccumulator::metrics() const {
  const auto volume = [&](voxel::BoneClass bone_class) {
    return static_cast<double>(coverage_removed_[static_cast<size_t>(bone_class)]) / 255.0 *
           voxel_volume_mm3_;
  };
  Metrics m;
  m.removed_volume_cancellous_mm3 = volume(voxel::BoneClass::cancellous);
  m.removed_volume_cortical_mm3 = volume(voxel::BoneClass::cortical);
  m.removed_volume_cartilage_mm3 = volume(voxel::BoneClass::cartilage);
  m.removed_volume_mm3 =
      m.removed_volume_cancellous_mm3 + m.removed_volume_cortical_mm3 + m.removed_volume_cartilage_mm3;
  m.reaming_depth_mm = touched_ ? deepest_mm_ - first_contact_mm_ : 0.0;
  m.axial_thrust_mean_n = cutting_ticks_ > 0 ? thrust_sum_n_ / static_cast<double>(cutting_ticks_) : 0.0;
  m.axial_thrust_peak_n = thrust_peak_n_;
  m.apparent_stiffness_n_mm = apparent_stiffness_n_mm_;
  m.duration_s = static_cast<double>(ticks_) * tick_s;
  m.weakened_time_s = static_cast<double>(weakened_ticks_) * tick_s;
  m.contact_time_s = static_cast<double>(contact_ticks_) * tick_s;
  m.session_hash = session_hash_;
  return m;
}

Findings MetricsAccumulator::handling() const {
  Findings f;
  f.say("axial_thrust_excess_n_s", thrust_excess_n_s_);
  f.leave("apparent_stiffness_n_mm", "thrust has not risen from 1 N to 90 % of 52 N in one go");
  f.say("passes", passes_.count());
  f.say("path_in_contact_mm", path_.in_contact_mm());
  f.say("path_out_of_contact_mm", path_.in_the_air_mm());
  const Strokes& strokes = path_.strokes();
  f.say("strokes", strokes.count());
  const char* no_stroke = "the tool made no stroke";
  f.say_or_leave("sparc", strokes.mean_sparc(), no_stroke);
  f.say_or_leave("ldlj", strokes.mean_ldlj(), no_stroke);
  const AdvanceUntilRelease& inside = breakthrough_.inside();
  if (inside.advance()) {
    f.say("breakthrough_advance_mm", inside.advance()->mm);
    f.say("breakthrough_time_s", inside.advance()->s);
  } else {
    for (const char* key : {"breakthrough_advance_mm", "breakthrough_time_s"})
      f.leave(key, inside.begun() ? "thrust has not fallen below 5 N since cancellous bone was reached"
                                  : "no cancellous bone was pressed on");
  }
  if (plate_stop_.beyond().advance())
    f.say("plate_overrun_mm", plate_stop_.beyond().advance()->mm);
  else
    f.leave("plate_overrun_mm", !plate_stop_.touched_cartilage() ? "no cartilage was reamed"
                                : plate_stop_.beyond().begun()
                                    ? "thrust has not fallen below 5 N since the plate was reached"
                                    : "the plate under the cartilage was not reached");
  return f;
}

nlohmann::json metrics_json(const Metrics& m, double force_scale, const uint64_t* grid_hash) {
  return {{"removed_volume_mm3", m.removed_volume_mm3},
          {"removed_volume_cortical_mm3", m.removed_volume_cortical_mm3},
          {"removed_volume_cancellous_mm3", m.removed_volume_cancellous_mm3},
          {"removed_volume_cartilage_mm3", m.removed_volume_cartilage_mm3},
          {"reaming_depth_mm", m.reaming_depth_mm},
          {"axial_thrust_mean_n", m.axial_thrust_mean_n},
          {"axial_thrust_peak_n", m.axial_thrust_peak_n},
          {"apparent_stiffness_n_mm",
           m.apparent_stiffness_n_mm ? nlohmann::json(*m.apparent_stiffness_n_mm) : nlohmann::json()},
          {"duration_s", m.duration_s},
          {"contact_time_s", m.contact_time_s},
          {"weakened_time_s", m.weakened_time_s},
          {"force_scale", force_scale},
          {"grid_hash", grid_hash ? nlohmann::json(to_hex(*grid_hash)) : nlohmann::json()},
          {"session_hash", to_hex(m.session_hash)}};
}

}  // namespace ream::score
