#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "score/metric_catalogue.hpp"

namespace ream::score {

/// Points rise linearly from 0 where a metric is at `none` to 100 at `full`, and stay there beyond both.
/// Either may be the larger.
struct Ramp {
  double none = 0.0, full = 1.0;
};

/// One line of a rubric. Without a ramp, points come from the band: 100 up to its pass limit, falling
/// linearly to 0 at its warn limit; outside of a band `between`, 50.
struct Criterion {
  std::string metric;  ///< a key of metrics.json whose value is a number
  std::optional<Ramp> ramp;
  std::optional<Band> band;  ///< in place of the catalogue's
  double weight = 1.0;
  bool critical = false;  ///< whoever fails its band fails, whatever the points

  /// The band that holds: its own, or the catalogue's.
  Band judged_by() const;
};

/// How metrics become points and a result; a file of proto/rubric.schema.json.
struct Rubric {
  std::string name;
  int version = 1;
  std::string remark;  ///< where its marks come from; may be empty
  std::optional<double> pass_points;
  /// Below this share of all weights, too little was measured for points to tell pass from fail.
  double min_measured_percent = 50.0;
  std::vector<Criterion> criteria;
};

/// Error not_found, invalid_input (names file and key).
Rubric load_rubric(const std::filesystem::path& path);
/// `place` names where it came from in errors. Error invalid_input: unknown keys, a criterion that gives no
/// points, a critical one without limits, no criterion at all.
Rubric rubric_from_json(const nlohmann::json& value, const std::string& place);
nlohmann::json rubric_json(const Rubric& rubric);

/// Of all that a rubric says, its name and version included.
uint64_t rubric_hash(const Rubric& rubric);

/// The rubric that holds where nobody chose one: proto/rubrics/standard.json.
const Rubric& standard_rubric();

}  // namespace ream::score
