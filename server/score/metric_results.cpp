#include "score/metric_results.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace ream::score {
namespace {

using nlohmann::json;

constexpr double steps_per_unit = 1e6;

double rounded(double value) {
  const double whole = std::floor(value * steps_per_unit + 0.5);
  return whole == 0.0 ? 0.0 : whole / steps_per_unit;
}

}  // namespace

void MetricResults::set(std::string_view key, double value) { set_exact(key, rounded(value)); }

void MetricResults::set_exact(std::string_view key, double value) {
  if (!std::isfinite(value)) return set_missing(key, "it could not be computed from what the session holds");
  missing_.erase(std::string(key));
  values_[std::string(key)] = value;
}

void MetricResults::set_missing(std::string_view key, std::string_view reason) {
  values_.erase(std::string(key));
  missing_[std::string(key)] = reason;
}

void MetricResults::set_missing(Basis basis, std::string_view reason) {
  for (const Metric& metric : metric_catalogue())
    if (metric.basis == basis) set_missing(metric.key, reason);
}

void MetricResults::set_or_missing(std::string_view key, const std::optional<double>& value,
                                   std::string_view reason) {
  if (value)
    set(key, *value);
  else
    set_missing(key, reason);
}

void MetricResults::merge(const MetricResults& other) {
  for (const auto& [key, value] : other.values_) set_exact(key, value);
  for (const auto& [key, reason] : other.missing_) set_missing(key, reason);
}

std::optional<double> MetricResults::value(std::string_view key) const {
  const auto found = values_.find(key);
  return found == values_.end() ? std::nullopt : std::optional(found->second);
}

std::string MetricResults::missing_reason(std::string_view key) const {
  const auto found = missing_.find(key);
  return found == missing_.end() ? std::string() : found->second;
}

json MetricResults::to_json() const {
  json metrics, missing = json::object();
  for (const Metric& metric : metric_catalogue()) {
    const std::string key(metric.key);
    const auto number = value(key);
    metrics[key] = number ? json(*number) : json();
    if (number) continue;
    const std::string reason = missing_reason(key);
    missing[key] = reason.empty() ? "it was not measured" : reason;
  }
  metrics["unsaid"] = missing;
  metrics["missing"] = std::move(missing);
  return metrics;
}

std::string missing_reason(const json& metrics, std::string_view key) {
  const auto found = metrics.find(std::string(key));
  if (found == metrics.end())
    return find_metric(key) ? "it was not measured when these metrics were made; score the session anew" : "";
  if (!found->is_null()) return "";
  const std::string unknown = "the session does not say it";
  for (const char* reasons : {"missing", "unsaid"})
    if (const auto all = metrics.find(reasons); all != metrics.end() && all->is_object())
      return all->value(std::string(key), unknown);
  return unknown;
}

}  // namespace ream::score
