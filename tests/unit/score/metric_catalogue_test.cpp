#include "score/metric_catalogue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/file.hpp"
#include "support/places.hpp"

namespace ream::score {
namespace {

TEST(MetricCatalogue, EveryMetricSaysWhatItIs) {
  std::set<std::string_view> keys;
  for (const Metric& m : metric_catalogue()) {
    EXPECT_TRUE(keys.insert(m.key).second) << m.key;
    EXPECT_FALSE(m.name.empty() || m.definition.empty() || m.source.empty() || m.confidence.empty()) << m.key;
    EXPECT_EQ(m.definition.back(), '.') << m.key;
    EXPECT_EQ(find_metric(m.key), &m);
  }
  EXPECT_EQ(find_metric("nothing"), nullptr);
}

TEST(MetricCatalogue, KeysEndWithTheirUnit) {
  for (const Metric& m : metric_catalogue()) {
    std::string ending(m.unit);
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c == '/' || c == ' ' ? '_' : static_cast<char>(std::tolower(c)); });
    if (ending.starts_with('%')) ending.replace(0, 1, "percent");
    EXPECT_TRUE(ending.empty() || std::string(m.key).ends_with("_" + ending)) << m.key;
  }
}

TEST(MetricCatalogue, BandsJudgeTheirLimitsAsScienceHasThem) {
  const auto judged = [](const char* key, double value) { return verdict(find_metric(key)->band, value); };
  EXPECT_EQ(judged("version_error_deg", 5.0), Verdict::pass);
  EXPECT_EQ(judged("version_error_deg", 10.0), Verdict::warn);
  EXPECT_EQ(judged("version_error_deg", 10.1), Verdict::fail);
  EXPECT_EQ(judged("seating_percent", 90.0), Verdict::pass);
  EXPECT_EQ(judged("seating_percent", 80.0), Verdict::warn);
  EXPECT_EQ(judged("seating_percent", 79.9), Verdict::fail);
  EXPECT_EQ(judged("vault_distance_mm", 2.0), Verdict::pass);
  EXPECT_EQ(judged("vault_distance_mm", 0.1), Verdict::warn);
  EXPECT_EQ(judged("vault_distance_mm", 0.0), Verdict::fail);
  EXPECT_EQ(judged("axial_thrust_mean_n", 35.0), Verdict::pass);
  EXPECT_EQ(judged("axial_thrust_mean_n", 34.0), Verdict::warn);
  EXPECT_EQ(judged("axial_thrust_peak_n", 104.5), Verdict::fail);
  EXPECT_EQ(judged("duration_s", 1e9), std::nullopt);
}

TEST(MetricCatalogue, GroupsFollowEachOther) {
  size_t metrics = 0;
  for (const MetricGroup group : {MetricGroup::alignment, MetricGroup::bone, MetricGroup::handling}) {
    for (const Metric& m : metrics_of(group)) EXPECT_EQ(m.group, group) << m.key;
    metrics += metrics_of(group).size();
  }
  EXPECT_EQ(metrics, metric_catalogue().size());
}

TEST(MetricCatalogue, PlannedValuesAreMetrics) {
  for (const Metric& m : metric_catalogue())
    EXPECT_TRUE(m.planned_by.empty() || find_metric(m.planned_by)) << m.key;
}

nlohmann::ordered_json schema_of(const Metric& metric) {
  nlohmann::ordered_json value;
  value["type"] = "number";
  if (metric.basis != Basis::ticks) value["type"] = {"number", "null"};
  const Range& range = metric.range;
  if (std::isfinite(range.min)) value[range.min_excluded ? "exclusiveMinimum" : "minimum"] = range.min;
  if (std::isfinite(range.max)) value["maximum"] = range.max;
  value["description"] = std::string(metric.name) + ", " +
                         (metric.unit.empty() ? "no unit" : std::string(metric.unit)) + ". " +
                         std::string(metric.definition);
  value["x-group"] = metric.group == MetricGroup::alignment ? "alignment"
                     : metric.group == MetricGroup::bone    ? "bone"
                                                            : "handling";
  value["x-limits"] = band_json(metric.band);
  value["x-source"] = metric.source;
  value["x-evidence"] = to_text(metric.evidence);
  value["x-confidence"] = metric.confidence;
  return value;
}

/// proto/metrics.schema.json, a line a metric.
std::string metrics_schema() {
  std::string required, properties;
  const auto add = [&](const std::string& key, const nlohmann::ordered_json& value, bool is_required = true) {
    if (is_required) required += (required.empty() ? "    " : ",\n    ") + nlohmann::json(key).dump();
    properties +=
        (properties.empty() ? "    " : ",\n    ") + nlohmann::json(key).dump() + ": " + value.dump();
  };
  for (const Metric& metric : metric_catalogue()) add(std::string(metric.key), schema_of(metric));
  using json = nlohmann::ordered_json;
  const json reasons = {{"type", "object"},
                        {"additionalProperties", json{{"type", "string"}, {"minLength", 1}}},
                        {"description", "Why a metric is null, by its key: one sentence each."}};
  json old_reasons = reasons;
  old_reasons["description"] = "The name that `missing` had in the version before; it will go.";
  add("force_scale", {{"type", "number"},
                      {"exclusiveMinimum", 0},
                      {"description", "Simulated newtons per newton of the hand."}});
  add("grid_hash", {{"type", {"string", "null"}},
                    {"pattern", "^[0-9a-f]{16}$"},
                    {"description", "Of the bone that is left; null while the session goes on."}});
  add("session_hash",
      {{"type", "string"}, {"pattern", "^[0-9a-f]{16}$"}, {"description", "Of all causes and changes."}});
  add("missing", reasons);
  add("unsaid", old_reasons, false);
  return R"({
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "$id": "metrics.schema.json",
  "title": "Metrics of a session",
  "description": "metrics.json, what `ream score` gives and what the API says of a session. A metric that could not be measured is null, with its reason in `missing`. Nothing differs between two equal runs. Made from the catalogue of metrics, server/score/metric_catalogue.cpp. Keys that begin with x- say how good a value is and where that comes from: limits, source, evidence (S published, M common knowledge, E engineering judgement, T tested here) and confidence.",
  "type": "object",
  "additionalProperties": false,
  "required": [
)" + required +
         "\n  ],\n  \"properties\": {\n" + properties + "\n  }\n}\n";
}

TEST(MetricCatalogue, MakesTheSchemaOfMetricsJson) {
  const auto path = std::filesystem::path(test::source_folder()) / "proto/metrics.schema.json";
  const std::string right = metrics_schema();
  EXPECT_TRUE(nlohmann::json::accept(right));
  if (read_text_file(path) == right) return;
  const auto made = std::filesystem::current_path() / "metrics.schema.json";
  write_file_atomically(made, right);
  FAIL() << path << " does not follow from the catalogue; copy " << made << " over it";
}

}  // namespace
}  // namespace ream::score
