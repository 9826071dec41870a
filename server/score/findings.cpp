#include "score/findings.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "score/metric_catalogue.hpp"

namespace ream::score {
namespace {

constexpr double roundings = 1e6;

double rounded(double value) {
  const double whole = std::floor(value * roundings + 0.5);
  return whole == 0.0 ? 0.0 : whole / roundings;
}

}  // namespace

void Findings::say(std::string_view key, double value) {
  if (!std::isfinite(value)) return leave(key, "it could not be computed from what the session holds");
  unsaid_.erase(std::string(key));
  said_[std::string(key)] = rounded(value);
}

void Findings::leave(std::string_view key, std::string_view reason) {
  said_.erase(std::string(key));
  unsaid_[std::string(key)] = reason;
}

void Findings::say_or_leave(std::string_view key, const std::optional<double>& value,
                            std::string_view reason) {
  if (value)
    say(key, *value);
  else
    leave(key, reason);
}

void Findings::take(const Findings& other) {
  for (const auto& [key, value] : other.said_) say(key, value);
  for (const auto& [key, reason] : other.unsaid_) leave(key, reason);
}

std::optional<double> Findings::said(std::string_view key) const {
  const auto found = said_.find(key);
  return found == said_.end() ? std::nullopt : std::optional(found->second);
}

std::string Findings::unsaid(std::string_view key) const {
  const auto found = unsaid_.find(key);
  return found == unsaid_.end() ? std::string() : found->second;
}

void Findings::write_to(nlohmann::json& metrics) const {
  nlohmann::json reasons = nlohmann::json::object();
  for (const Metric& metric : metric_catalogue()) {
    const std::string key(metric.key);
    if (!metrics.contains(key)) {
      const auto value = said(key);
      metrics[key] = value ? nlohmann::json(*value) : nlohmann::json();
    }
    if (!metrics[key].is_null()) continue;
    const std::string reason = unsaid(key);
    reasons[key] = reason.empty() ? "it was not measured" : reason;
  }
  metrics["unsaid"] = std::move(reasons);
}

}  // namespace ream::score
