#pragma once
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "score/metric_catalogue.hpp"

namespace ream::score {

/// The metrics of a session by the keys of the catalogue: a value each, or the reason why it is missing.
/// Never holds a number that is not finite. A reason is one sentence without a full stop.
class MetricResults {
 public:
  /// Rounded to 1e-6 of its unit, so that rounding of the computation does not show.
  void set(std::string_view key, double value);
  /// Every bit of it: an exact sum.
  void set_exact(std::string_view key, double value);
  void set_missing(std::string_view key, std::string_view reason);
  /// All metrics of the catalogue that rest on `basis`.
  void set_missing(Basis basis, std::string_view reason);
  void set_or_missing(std::string_view key, const std::optional<double>& value, std::string_view reason);
  /// Takes over what `other` has; where both have something, other's.
  void merge(const MetricResults& other);

  std::optional<double> value(std::string_view key) const;
  /// Empty: it has a value, or nothing is known of it.
  std::string missing_reason(std::string_view key) const;

  /// Every metric of the catalogue: its number, or null; in "missing" the reasons of those that are null.
  /// "unsaid" is the name that "missing" had in the version before, written for its readers.
  nlohmann::json to_json() const;

 private:
  std::map<std::string, double, std::less<>> values_;
  std::map<std::string, std::string, std::less<>> missing_;
};

/// Why a metric of a metrics.json has no number; empty for one that has, and for one that nobody knows. Reads
/// files of the version before, too.
std::string missing_reason(const nlohmann::json& metrics, std::string_view key);

}  // namespace ream::score
