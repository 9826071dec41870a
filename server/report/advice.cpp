#include "report/advice.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/metric_tables.hpp"
#include "report/number_text.hpp"
#include "score/metric_catalogue.hpp"

namespace ream::report {
namespace {

using nlohmann::json;

constexpr double least_loss = 1.0;
constexpr double experiments_thrust_n = 52.0;
constexpr std::string_view value_mark = "{}";

/// What to do about a metric; `{}` stands for its value.
struct Words {
  std::string_view metric, words;
};

constexpr Words words_of_metrics[] = {
    {"version_error_deg",
     "Line the reamer up with the planned version before you press: its axis was {} off."},
    {"inclination_error_deg",
     "Line the reamer up with the planned inclination before you press: its axis was {} off."},
    {"entry_error_mm", "Set the reamer down on the planned entry: it cut {} beside it."},
    {"seating_short_percent",
     "Give the face the component's shape: {} less of its back rests on bone than planned."},
    {"seating_percent", "Give the face the component's shape: only {} of its back rests on bone."},
    {"axis_error_deg", "Hold the reamer along the planned axis: it was {} off."},
    {"plate_lost_percent", "Spare the hard layer under the face: {} of it is gone beyond the plan."},
    {"congruity_mm", "Hold the axis still to the end: the surface is uneven by {}."},
    {"vault_breach_mm",
     "Keep pegs or keel inside the bone: along this axis they come {} through the cortex."},
    {"perforated_area_mm2", "Stop before the bone ends: the reamer left a hole of {}."},
    {"version_excess_deg", "Bring the face nearer to neutral version: it leans {} too far."},
    {"overload_time_s", "Press less at the peaks: thrust was over 78 N for {}."},
    {"time_over_56_s", "Rinse while you ream: the bone was at 56 degrees or more for {}."},
    {"medialization_mm", "Take less bone: the face moved in by {}."},
    {"plate_preserved_percent", "Spare the hard layer under the face: {} of it is left."},
    {"axial_thrust_peak_n", "Press less at the peaks: thrust went up to {}."},
};

/// Too much was removed, rather than too little.
bool went_too_far(const json& metrics) {
  return number_of(metrics, "overreamed_volume_mm3") > number_of(metrics, "underreamed_volume_mm3");
}

std::string filled(std::string_view words, const std::string& value) {
  std::string text(words);
  if (const size_t at = text.find(value_mark); at != std::string::npos)
    text.replace(at, value_mark.size(), value);
  return text;
}

std::string depth_words(double error_mm, const json& metrics) {
  const std::optional<double> planned = number_of(metrics, "depth_planned_mm"),
                              reached = number_of(metrics, "reaming_depth_mm");
  const char* words = !planned || !reached  ? "Stop at the planned depth: the reaming is {} off."
                      : *reached > *planned ? "Stop earlier: the reaming is {} deeper than planned."
                                            : "Go on to the planned depth: {} are missing.";
  return filled(words, with_unit(error_mm, "mm"));
}

/// Of metrics that can be wrong in two ways; empty for the others.
std::string words_by_direction(const std::string& metric, double value, const json& metrics) {
  if (metric == "depth_error_mm") return depth_words(value, metrics);
  if (metric == "plan_overlap_percent")
    return went_too_far(metrics)
               ? filled("Take less bone: {} are gone that the plan leaves.",
                        with_unit(number_of(metrics, "overreamed_volume_mm3").value_or(0.0), "mm3"))
               : filled("Take all that is planned: {} of it are left.",
                        with_unit(number_of(metrics, "underreamed_volume_mm3").value_or(0.0), "mm3"));
  if (metric == "axial_thrust_mean_n")
    return filled(value < experiments_thrust_n ? "Press harder while you cut: it was {} on average."
                                               : "Press less while you cut: it was {} on average.",
                  with_unit(value, "N"));
  return "";
}

std::string words_of(const std::string& metric, double value, const json& metrics) {
  if (std::string words = words_by_direction(metric, value, metrics); !words.empty()) return words;
  const score::Metric* known = score::find_metric(metric);
  const std::string value_text = known ? with_unit(value, known->unit) : shortest(value);
  for (const Words& each : words_of_metrics)
    if (each.metric == metric) return filled(each.words, value_text);
  return (known ? std::string(known->name) : metric) + " was " + value_text + ".";
}

}  // namespace

std::vector<Advice> advice_of(const json& score, const json& metrics) {
  double weights = 0.0;
  for (const json& c : score.at("criteria"))
    if (c.at("points").is_number()) weights += c.at("weight").get<double>();
  std::vector<Advice> advice;
  for (const json& c : score.at("criteria")) {
    if (!c.at("points").is_number() || !c.at("value").is_number()) continue;
    const double weight = weights > 0.0 ? c.at("weight").get<double>() / weights : 0.0;
    Advice one;
    one.metric = c.at("metric").get<std::string>();
    one.lost_points = weight * (100.0 - c.at("points").get<double>());
    one.decides = c.at("critical") == true && c.at("verdict") == "fail";
    if (one.lost_points < least_loss && !one.decides) continue;
    one.words = words_of(one.metric, c.at("value").get<double>(), metrics);
    advice.push_back(std::move(one));
  }
  std::stable_sort(advice.begin(), advice.end(), [](const Advice& a, const Advice& b) {
    return a.decides != b.decides ? a.decides : a.lost_points > b.lost_points;
  });
  if (advice.size() > max_advice) advice.resize(max_advice);
  return advice;
}

}  // namespace ream::report
