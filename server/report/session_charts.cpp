#include "report/session_charts.hpp"

#include <algorithm>

#include "report/number_text.hpp"
#include "score/handling.hpp"

namespace ream::report {
namespace {

constexpr double minutes_from_s = 240.0;

/// The axis of time, in minutes where seconds would be many.
struct TimeAxis {
  double per_second = 1.0;
  std::string name = "s";

  explicit TimeAxis(double duration_s) {
    if (duration_s < minutes_from_s) return;
    per_second = 1.0 / 60.0;
    name = "min";
  }
};

Chart timed_chart(const TraceSummary& trace, const std::vector<Remark>& remarks) {
  const TimeAxis time(trace.duration_s());
  Chart chart;
  chart.x_name = "time, " + time.name;
  chart.x_max = std::max(trace.duration_s(), 1e-3) * time.per_second;
  for (size_t i = 0; i < remarks.size(); ++i)
    chart.moments.push_back({remarks[i].at_s * time.per_second, std::to_string(i + 1)});
  return chart;
}

/// Points of all parts; `point` gives what lies over one, or nothing.
template <typename Point>
Curve curve_of(const TraceSummary& trace, const Point& point) {
  const TimeAxis time(trace.duration_s());
  Curve curve;
  bool goes_on = false;
  for (size_t i = 0; i < trace.bins().size(); ++i) {
    std::optional<CurvePoint> next = point(trace.bins()[i]);
    if (next) {
      if (!goes_on) curve.parts.emplace_back();
      next->x = (static_cast<double>(i) + 0.5) * trace.bin_s() * time.per_second;
      curve.parts.back().push_back(*next);
    }
    goes_on = next.has_value();
  }
  return curve;
}

double highest(const Curve& curve) {
  double high = 0.0;
  for (const auto& part : curve.parts)
    for (const CurvePoint& point : part) high = std::max(high, point.high);
  return high;
}

double lowest(const Curve& curve) {
  double low = 0.0;
  for (const auto& part : curve.parts)
    for (const CurvePoint& point : part) low = std::min(low, point.low);
  return low;
}

Chart thrust_chart(const TraceSummary& trace, const std::vector<Remark>& remarks) {
  Chart chart = timed_chart(trace, remarks);
  chart.title = "Thrust";
  chart.y_name = "simulated N";
  chart.curves.push_back(curve_of(trace, [](const TraceBin& bin) -> std::optional<CurvePoint> {
    return CurvePoint{0.0, bin.thrust_low_n, bin.thrust_high_n};
  }));
  const double peak_n = highest(chart.curves.front());
  chart.y_max = std::max(115.0, 1.08 * peak_n);
  const score::Band& mean = score::find_metric("axial_thrust_mean_n")->band;
  const score::Band& peak = score::find_metric("axial_thrust_peak_n")->band;
  chart.ranges.push_back(
      {mean.low, mean.pass, "mean: " + shortest(mean.low) + " to " + shortest(mean.pass) + " N"});
  chart.levels.push_back({score::excess_from_n, "excess: over " + shortest(score::excess_from_n) + " N"});
  chart.levels.push_back({peak.pass, "peak: up to " + shortest(peak.pass) + " N"});
  const TimeAxis time(trace.duration_s());
  chart.stretches_name = "contact";
  for (size_t i = 0; i < trace.bins().size(); ++i) {
    if (!trace.bins()[i].touched) continue;
    const double from = static_cast<double>(i) * trace.bin_s() * time.per_second;
    const double to = from + trace.bin_s() * time.per_second;
    if (!chart.stretches.empty() && chart.stretches.back().to >= from - 1e-9)
      chart.stretches.back().to = to;
    else
      chart.stretches.push_back({from, to});
  }
  chart.alt_text =
      "Thrust over " + duration_text(trace.duration_s()) + ", at most " + decimal(peak_n, 0) + " N";
  return chart;
}

Chart feed_chart(const TraceSummary& trace, const std::vector<Remark>& remarks) {
  Chart chart = timed_chart(trace, remarks);
  chart.title = "Feed while cutting";
  chart.y_name = "mm/s";
  chart.curves.push_back(curve_of(trace, [](const TraceBin& bin) -> std::optional<CurvePoint> {
    return CurvePoint{0.0, std::max(0.0, bin.feed_low_mm_s), std::max(0.0, bin.feed_high_mm_s)};
  }));
  chart.y_max = std::max(0.1, 1.1 * highest(chart.curves.front()));
  chart.alt_text = "Feed over time, at most " + decimal(highest(chart.curves.front()), 2) + " mm/s";
  return chart;
}

Chart depth_chart(const TraceSummary& trace, double planned_depth_mm, const std::vector<Remark>& remarks) {
  Chart chart = timed_chart(trace, remarks);
  chart.title = "Travel of the reamer past first contact";
  chart.y_name = "mm";
  chart.curves.push_back(curve_of(trace, [](const TraceBin& bin) -> std::optional<CurvePoint> {
    if (!bin.depth_mm) return std::nullopt;
    return CurvePoint{0.0, *bin.depth_mm, *bin.depth_mm};
  }));
  const double deepest = highest(chart.curves.front());
  chart.y_max = std::max({1.0, 1.15 * deepest, 1.25 * planned_depth_mm});
  chart.y_min = std::max(1.1 * lowest(chart.curves.front()), -0.5 * chart.y_max);
  if (planned_depth_mm > 0.0)
    chart.levels.push_back({planned_depth_mm, "plan: " + with_unit(planned_depth_mm, "mm")});
  chart.alt_text = "Depth over time, at most " + with_unit(deepest, "mm");
  return chart;
}

}  // namespace

std::vector<Chart> session_charts(const TraceSummary& trace, double planned_depth_mm,
                                  const std::vector<Remark>& remarks) {
  return {thrust_chart(trace, remarks), feed_chart(trace, remarks),
          depth_chart(trace, planned_depth_mm, remarks)};
}

std::vector<Chart> learning_charts(const score::LearningCurve& curve,
                                   const std::optional<double>& pass_points) {
  if (curve.points.size() < 2) return {};
  const score::CusumLimits limits = score::cusum_limits(curve.parameters);
  Chart sums, points;
  sums.x_name = points.x_name = "session";
  sums.whole_x = points.whole_x = true;
  sums.x_min = points.x_min = 0.5;
  sums.x_max = points.x_max = static_cast<double>(curve.points.size()) + 0.5;
  sums.title = "CUSUM";
  sums.y_name = "sum";
  sums.levels = {{limits.proficient_at, "proficient"}, {limits.not_proficient_at, "not proficient"}};
  points.title = "Points";
  points.y_name = "points";
  points.y_max = 105.0;
  if (pass_points) points.levels.push_back({*pass_points, shortest(*pass_points) + " to pass"});
  Curve sum, each;
  sum.dots = each.dots = true;
  for (size_t i = 0; i < curve.points.size(); ++i) {
    const double x = static_cast<double>(i) + 1.0;
    const score::LearningPoint& point = curve.points[i];
    if (point.cusum) {
      if (sum.parts.empty()) sum.parts.emplace_back();
      sum.parts.back().push_back({x, point.cusum->sum, point.cusum->sum});
      if (point.cusum->decided != score::Standing::going_on) sum.parts.emplace_back();
    }
    if (point.points) {
      if (each.parts.empty()) each.parts.emplace_back();
      each.parts.back().push_back({x, *point.points, *point.points});
    }
  }
  if (!sum.parts.empty() && sum.parts.back().empty()) sum.parts.pop_back();
  sums.y_min = 1.25 * std::min(limits.proficient_at, lowest(sum));
  sums.y_max = 1.25 * std::max(limits.not_proficient_at, highest(sum));
  sums.curves.push_back(std::move(sum));
  points.curves.push_back(std::move(each));
  sums.alt_text = "CUSUM over " + std::to_string(curve.points.size()) +
                  " sessions: " + std::string(score::to_text(curve.standing()));
  points.alt_text = "Points over " + std::to_string(curve.points.size()) + " sessions";
  return {points, sums};
}

}  // namespace ream::report
