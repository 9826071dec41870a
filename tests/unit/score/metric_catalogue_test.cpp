#include "score/metric_catalogue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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
    if (ending == "%") ending = "percent";
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

TEST(MetricCatalogue, IsDescribedByTheSchemaOfMetricsJson) {
  const nlohmann::json schema =
      read_json_file(std::filesystem::path(test::source_folder()) / "proto/metrics.schema.json");
  const nlohmann::json& described = schema.at("properties");
  for (const Metric& m : metric_catalogue()) EXPECT_TRUE(described.contains(std::string(m.key))) << m.key;
  for (const auto& [key, value] : described.items()) {
    const bool other =
        std::set<std::string>{"force_scale", "grid_hash", "session_hash", "unsaid"}.contains(key);
    EXPECT_TRUE(other || find_metric(key) != nullptr) << key;
  }
}

TEST(MetricCatalogue, GoesToPagesAsJson) {
  const nlohmann::json list = catalogue_json();
  ASSERT_EQ(list.size(), metric_catalogue().size());
  const auto& version =
      *std::find_if(list.begin(), list.end(), [](const auto& m) { return m["key"] == "version_error_deg"; });
  EXPECT_EQ(version["evidence"], "S");
  EXPECT_EQ(version["band"], (nlohmann::json{{"better", "less"}, {"pass", 5.0}, {"warn", 10.0}}));
}

}  // namespace
}  // namespace ream::score
