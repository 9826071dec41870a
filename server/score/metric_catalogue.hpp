#pragma once
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "score/band.hpp"

namespace ream::score {

/// Where the limits or the definition of a metric come from.
enum class Evidence {
  published,  ///< read in a public source, which is named
  field,      ///< common knowledge of the field, not read in a source
  judgement,  ///< engineering judgement, a named and documented choice
  tested      ///< computed or tested for this project
};

/// What a metric rests on. Where that is not there, the metric is missing, with the reason.
enum class Basis {
  ticks,           ///< sums over all ticks: never missing
  episode,         ///< something that a session need not hold: a stroke, a breakthrough
  plan,            ///< of the case, whatever the session does
  untouched_bone,  ///< the face before the session
  reamed_bone,     ///< the face and what was removed of it
  achieved_axis    ///< where the tool cut last
};

enum class MetricGroup { alignment, bone, handling };

/// Values that a metric can have at all, in its unit.
struct Range {
  double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
  bool min_excluded = false;
};

/// How people read a value.
enum class Style {
  number,      ///< with its unit
  version,     ///< "12.0 degrees retroversion"
  inclination  ///< "5.0 degrees superior"
};

/// One number of metrics.json, for people and for whoever judges it. Everything that names, prints, limits or
/// describes a metric reads it from here.
struct Metric {
  std::string_view key;   ///< of metrics.json; ends with its unit
  std::string_view name;  ///< for people
  std::string_view unit;  ///< "" where there is none
  std::string_view definition;
  std::string_view source;
  Evidence evidence = Evidence::judgement;
  std::string_view confidence;  ///< how sure the number and its limits are
  MetricGroup group = MetricGroup::alignment;
  Basis basis = Basis::ticks;
  Range range;
  Band band;
  /// Which way is better, for a metric without limits; empty: its band tells, or it is no achievement.
  std::optional<Better> aim = std::nullopt;
  Style style = Style::number;
  /// Key of the metric that holds what was planned: it is printed beside this one, not in a line of its own.
  std::string_view planned_by = "";
};

/// All metrics with a number, in the order in which people read them, group after group.
std::span<const Metric> metric_catalogue();
std::span<const Metric> metrics_of(MetricGroup group);

/// Null when there is no such metric.
const Metric* find_metric(std::string_view key);

/// Which way is better, by its band or its aim; empty for those that are no achievement (planned angles,
/// volumes) and for bands `between`.
std::optional<Better> aim_of(const Metric& metric);

/// In one letter, as metrics.schema.json has it: "S", "M", "E", "T".
std::string_view to_text(Evidence evidence);

}  // namespace ream::score
