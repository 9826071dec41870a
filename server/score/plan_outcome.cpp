#include "score/plan_outcome.hpp"

#include <nlohmann/json.hpp>

#include "core/json.hpp"
#include "score/depth_gauge.hpp"
#include "score/planned_face.hpp"
#include "score/vault_clearance.hpp"

namespace ream::score {

MetricResults plan_outcome(const NativeGlenoid& native) {
  MetricResults outcome;
  const std::optional<PlannedCut> cut = planned_cut(native);
  if (!cut) return outcome;
  const PlannedFace planned = planned_face(native);
  double removed_mm = 0.0;
  int reamed = 0;
  for (const double mm : planned.removed_mm) {
    removed_mm += mm >= reamed_mm ? mm : 0.0;
    reamed += mm >= reamed_mm;
  }
  outcome.set("footprint_area_mm2", reamed * native.rays().cell_area_mm2());
  outcome.set("depth_mean_mm", reamed > 0 ? removed_mm / reamed : 0.0);
  outcome.set("medialization_mm", greatest_depth(native, cut->face).past_subchondral_mm);
  outcome.set_or_missing("seating_percent", planned.seating_percent, not_planned);
  outcome.set_or_missing("plate_preserved_percent", planned.plate_percent, not_planned);
  outcome.set_or_missing("joint_line_mm", planned.joint_line_mm, not_planned);
  measure_vault_clearance(native, Component(native, cut->face, cut->line), cut->line, outcome);
  return outcome;
}

nlohmann::json outcome_json(const MetricResults& outcome) {
  nlohmann::json numbers;
  for (const std::string_view metric : outcome_metrics) numbers[metric] = or_null(outcome.value(metric));
  return numbers;
}

}  // namespace ream::score
