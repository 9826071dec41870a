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
