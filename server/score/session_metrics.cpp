#include "score/session_metrics.hpp"

#include <nlohmann/json.hpp>

#include "score/alignment_findings.hpp"
#include "score/surface_findings.hpp"

namespace ream::score {

nlohmann::json session_metrics_json(const MetricsAccumulator& ticks, const Findings& of_bone,
                                    double force_scale, const uint64_t* grid_hash) {
  nlohmann::json metrics = metrics_json(ticks.metrics(), force_scale, grid_hash);
  Findings findings = ticks.handling();
  findings.take(of_bone);
  findings.write_to(metrics);
  return metrics;
}

Findings bone_unsaid(const std::string& reason) {
  Findings findings;
  leave_bone(reason, findings);
  leave_alignment(reason, findings);
  for (const char* key :
       {"plate_thickness_mm", "version_planned_deg", "inclination_planned_deg", "plan_correction_deg"})
    findings.leave(key, reason);
  return findings;
}

}  // namespace ream::score
