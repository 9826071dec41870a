#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "score/metric_catalogue.hpp"

namespace ream::test {

/// A metrics.json that has three metrics, all of them worse the larger `size` is, and why it lacks the
/// others.
inline nlohmann::json some_metrics(double size) {
  nlohmann::json metrics = {{"force_scale", 26.0},
                            {"grid_hash", "00112233445566ff"},
                            {"session_hash", "0123456789abcdef"},
                            {"missing", nlohmann::json::object()}};
  for (const score::Metric& metric : score::metric_catalogue()) {
    metrics[std::string(metric.key)] = nullptr;
    metrics["missing"][std::string(metric.key)] = "no bone was removed";
  }
  for (const char* measured : {"duration_s", "contact_time_s", "version_error_deg"}) {
    metrics[measured] = size;
    metrics["missing"].erase(measured);
  }
  return metrics;
}

}  // namespace ream::test
