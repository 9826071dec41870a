#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "score/group_cut.hpp"
#include "score/measured_session.hpp"
#include "score/rubric_score.hpp"

namespace ream::score {

/// Cuts of the points by a rubric ("points") and of every metric that has an aim and is said by both groups.
/// Where groups cannot be cut, the entry has `error` in place of figures.
nlohmann::json group_cuts_json(const std::vector<MeasuredSession>& novices,
                               const std::vector<MeasuredSession>& experts, const Rubric& rubric,
                               Density density);

/// Error invalid_input for other words than normal and kernel.
Density density_from_text(const std::string& text);

}  // namespace ream::score
