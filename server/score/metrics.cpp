#include "score/metrics.hpp"

#include <nlohmann/json.hpp>

#include "core/hash.hpp"

namespace ream::score {

MetricsAccumulator::MetricsAccumulator(double voxel_volume_mm3, const Pose& plan_from_world)
    : voxel_volume_mm3_(voxel_volume_mm3), plan_from_world_(plan_from_world) {}

void MetricsAccumulator::add(const record::TickReport& r) {
  session_hash_ = r.session_hash;
  const Vec3 in_bone_mm = r.world_from_bone_rest.inverse().point(r.world_from_tool.translation_mm);
  const double axial_mm = plan_from_world_.point(in_bone_mm).z();
  for (size_t k = 0; k < voxel::bone_class_count; ++k) coverage_removed_[k] += r.coverage_removed[k];
  const Pose bone_from_tool = r.world_from_bone_rest.inverse() * r.world_from_tool;
  cut_axis_.add(plan_from_world_ * bone_from_tool,
                r.coverage_removed[0] + r.coverage_removed[1] + r.coverage_removed[2]);
  handling_.add(r, in_bone_mm, axial_mm);
  heating_.add(r);
  axis_steadiness_.add(r, bone_from_tool);
}

double MetricsAccumulator::removed_mm3(voxel::BoneClass bone_class) const {
  return static_cast<double>(coverage_removed_[static_cast<size_t>(bone_class)]) / 255.0 * voxel_volume_mm3_;
}

double MetricsAccumulator::removed_volume_mm3() const {
  return removed_mm3(voxel::BoneClass::cancellous) + removed_mm3(voxel::BoneClass::cortical) +
         removed_mm3(voxel::BoneClass::cartilage);
}

MetricResults MetricsAccumulator::results() const {
  MetricResults results;
  results.set_exact("removed_volume_mm3", removed_volume_mm3());
  results.set_exact("removed_volume_cortical_mm3", removed_mm3(voxel::BoneClass::cortical));
  results.set_exact("removed_volume_cancellous_mm3", removed_mm3(voxel::BoneClass::cancellous));
  results.set_exact("removed_volume_cartilage_mm3", removed_mm3(voxel::BoneClass::cartilage));
  handling_.write(results);
  heating_.write(results);
  axis_steadiness_.write(results);
  return results;
}

nlohmann::json session_metrics_json(const MetricsAccumulator& ticks, const MetricResults& of_bone,
                                    double force_scale, const uint64_t* grid_hash) {
  MetricResults results = ticks.results();
  results.merge(of_bone);
  nlohmann::json metrics = results.to_json();
  metrics["force_scale"] = force_scale;
  metrics["grid_hash"] = grid_hash ? nlohmann::json(to_hex(*grid_hash)) : nlohmann::json();
  metrics["session_hash"] = to_hex(ticks.session_hash());
  return metrics;
}

}  // namespace ream::score
