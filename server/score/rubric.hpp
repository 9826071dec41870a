#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "score/metric_catalogue.hpp"

namespace ream::score {

/// Points rise linearly from 0 where a metric is at `none` to 100 at `full`, and stay there beyond both.
/// Either may be the larger.
struct Ramp {
  double none = 0.0, full = 1.0;
};

/// A value of a metric and what it is worth, 0 to 100 points.
struct CurvePoint {
  double at = 0.0, points = 0.0;
};

/// One line of a rubric. Without a curve or a ramp, points come from the band: 100 up to its pass limit,
/// falling linearly to 0 at its warn limit; outside of a band `between`, 50.
struct Criterion {
  std::string metric;  ///< a key of metrics.json whose value is a number
  std::optional<Ramp> ramp;
  std::optional<Band> band;  ///< in place of the catalogue's
  double weight = 1.0;
  bool critical = false;  ///< whoever fails its band fails, whatever the points
  /// Straight between its points, which ascend, and level beyond both ends.
  std::vector<CurvePoint> curve = {};
  std::string source = {};  ///< where curve, limits and weight come from; may be empty

  /// The band that holds: its own, or the catalogue's.
  Band judged_by() const;
};

/// How metrics become points and a result; a file of proto/rubric.schema.json.
struct Rubric {
  std::string name;
  int version = 1;
  std::string remark;  ///< where its marks come from; may be empty
  std::optional<double> pass_points;
  /// Below this share of all weights, too little was measured: there are no points, and no result by points.
  double min_measured_percent = 50.0;
  std::vector<Criterion> criteria;
};

/// Error not_found, invalid_input (names file and key).
Rubric load_rubric(const std::filesystem::path& path);
/// `place` names where it came from in errors. Error invalid_input: unknown keys, a criterion that gives no
/// points, a critical one without limits, no criterion at all.
Rubric rubric_from_json(const nlohmann::json& value, const std::string& place);
nlohmann::json rubric_json(const Rubric& rubric);

/// Points as everybody reads them: rounded down to a tenth, so never up to a mark.
double rounded_points(double points);

/// Of all that a rubric says, its name and version included.
uint64_t rubric_hash(const Rubric& rubric);

/// The rubric that holds where nobody chose one: proto/rubrics/standard.json.
const Rubric& standard_rubric();
/// All versions of it that the program ever came with, version i + 1 at place i: who was judged by one of
/// them can be judged so again.
std::span<const Rubric> standard_rubrics();

}  // namespace ream::score
