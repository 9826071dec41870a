#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "report/report.hpp"

namespace ream::report {

/// Value of a metric in metrics.json; empty where it is null or not there.
std::optional<double> number_of(const nlohmann::json& metrics, std::string_view key);

/// Three tables of all metrics (alignment, bone, handling); appends each source that is named to `sources`.
std::vector<MetricTable> metric_tables(const Material& material, std::vector<std::string>& sources);

/// What every metric of the catalogue means: its unit beside its name, definition, confidence, and the number
/// of its source; appends those to `sources` that are not there yet.
std::vector<Fact> metric_meanings(std::vector<std::string>& sources);

/// Reasons why metrics are missing, in the order of the catalogue; `name`: of all metrics with that reason.
std::vector<Fact> missing_metrics(const nlohmann::json& metrics);

}  // namespace ream::report
