#pragma once
#include <vector>

#include "report/chart.hpp"
#include "report/material.hpp"

namespace ream::report {

/// Thrust about the thesis' 52 N (science 2.2), as the metrics have it: where the mean should lie, from where
/// on it is excess, and what no moment should pass.
inline constexpr double thrust_from_n = 35.0, thrust_to_n = 70.0, thrust_excess_n = 78.0,
                        thrust_peak_n = 104.0;

/// Thrust, feed and depth over time; remarks are numbered from 1.
std::vector<Chart> session_charts(const TraceSummary& trace, double planned_depth_mm,
                                  const std::vector<Remark>& remarks);

/// CUSUM and points over a trainee's sessions; empty for fewer than two.
std::vector<Chart> learning_charts(const score::LearningCurve& curve,
                                   const std::optional<double>& pass_points);

}  // namespace ream::report
