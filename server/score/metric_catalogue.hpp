#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string_view>

namespace ream::score {

/// Where the limits or the definition of a metric come from.
enum class Evidence {
  published,  ///< read in a public source, which is named
  field,      ///< common knowledge of the field, not read in a source
  judgement,  ///< engineering judgement, a named and documented choice
  tested      ///< computed or tested for this project
};

/// Which values of a metric are good.
enum class Better { report_only, less, more, between };

/// Limits in the metric's unit. `less`: up to `pass` passes, up to `warn` warns, more fails; `more` the other
/// way round; `between`: from `low` to `pass` passes, all else warns.
struct Band {
  Better better = Better::report_only;
  double pass = 0.0, warn = 0.0, low = 0.0;
};

/// One number of metrics.json, for people and for whoever judges it.
struct Metric {
  std::string_view key;   ///< of metrics.json; ends with its unit
  std::string_view name;  ///< for people
  std::string_view unit;  ///< "" where there is none
  std::string_view definition;
  std::string_view source;
  Evidence evidence = Evidence::judgement;
  std::string_view confidence;  ///< how sure the number and its limits are, in words
  Band band;
  bool live = true;  ///< said while the session goes on, too
};

/// All metrics with a number, in the order in which people read them.
std::span<const Metric> metric_catalogue();

/// Null when there is no such metric.
const Metric* find_metric(std::string_view key);

enum class Verdict { pass, warn, fail };

/// Empty for metrics that are only reported.
std::optional<Verdict> verdict(const Band& band, double value);

/// As science.md marks them: "S", "M", "E", "T".
std::string_view to_text(Evidence evidence);
std::string_view to_text(Verdict verdict);

/// The catalogue as a JSON list, for pages and exports.
nlohmann::json catalogue_json();

}  // namespace ream::score
