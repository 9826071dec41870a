#pragma once
#include <vector>

#include "report/chart.hpp"
#include "report/material.hpp"

namespace ream::report {

/// Thrust (with the limits of its metrics), feed and depth over time; remarks are numbered from 1.
std::vector<Chart> session_charts(const TraceSummary& trace, double planned_depth_mm,
                                  const std::vector<Remark>& remarks);

/// CUSUM and points over a trainee's sessions; empty for fewer than two.
std::vector<Chart> learning_charts(const score::LearningCurve& curve,
                                   const std::optional<double>& pass_points);

}  // namespace ream::report
