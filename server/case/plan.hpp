#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "case/case.hpp"

namespace ream::case_ {

/// plan.json (proto/plan.schema.json): entry_mm, axis_direction, depth_mm, reamer and, both or neither,
/// pilot_diameter_mm and pilot_depth_mm; what was aimed at (implant, version_deg, inclination_deg) and an
/// override of the limit of correction are written only where they are. The direction is scaled to unit
/// length. `place` names the file in errors. Errors: invalid_input (names place and key; unknown keys are
/// refused).
Plan plan_from_json(const nlohmann::json& value, const std::string& place);
nlohmann::json to_json(const Plan& plan);

/// Throws Error invalid_input unless every number is finite and in its range; `place` names the plan.
void validate(const Plan& plan, const std::string& place);

}  // namespace ream::case_
