#include "score/metric_results.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "score/metric_catalogue.hpp"

namespace ream::score {
namespace {

TEST(MetricResults, NeverHoldWhatIsNoNumber) {
  MetricResults f;
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    f.set("passes", 2.0);
    f.set("passes", value);
    EXPECT_FALSE(f.value("passes"));
    EXPECT_NE(f.missing_reason("passes"), "");
  }
}

TEST(MetricResults, AreRoundedSoThatOnlyWhatIsMeantShows) {
  MetricResults f;
  f.set("sparc", -1.4140271);
  EXPECT_EQ(*f.value("sparc"), -1.414027);
  f.set("sparc", -1e-9);
  EXPECT_FALSE(std::signbit(*f.value("sparc")));
}

TEST(MetricResults, GiveEveryMetricOfTheCatalogueAValueOrAReason) {
  MetricResults f;
  f.set_exact("duration_s", 3.00000049);
  f.set("seating_percent", 91.0);
  f.set_missing("congruity_mm", "nothing was reamed");
  const nlohmann::json metrics = f.to_json();
  for (const Metric& metric : metric_catalogue()) {
    const std::string key(metric.key);
    ASSERT_TRUE(metrics.contains(key)) << key;
    EXPECT_NE(metrics.at(key).is_null(), !metrics.at("missing").contains(key)) << key;
  }
  EXPECT_EQ(metrics["duration_s"], 3.00000049);
  EXPECT_EQ(metrics["seating_percent"], 91.0);
  EXPECT_EQ(metrics["missing"]["congruity_mm"], "nothing was reamed");
  EXPECT_EQ(metrics["unsaid"], metrics["missing"]) << "the name of the version before";
}

TEST(MetricResults, AreMissingTogetherWithWhatTheyRestOn) {
  MetricResults f;
  f.set_missing(Basis::reamed_bone, "no bone was removed");
  for (const Metric& metric : metric_catalogue())
    EXPECT_EQ(f.missing_reason(metric.key), metric.basis == Basis::reamed_bone ? "no bone was removed" : "")
        << metric.key;
}

TEST(MetricResults, ReasonsAreReadFromFilesOfTheVersionBeforeToo) {
  for (const char* reasons : {"missing", "unsaid"}) {
    const nlohmann::json metrics = {{"sparc", nullptr}, {"passes", 2.0}, {reasons, {{"sparc", "no stroke"}}}};
    EXPECT_EQ(missing_reason(metrics, "sparc"), "no stroke");
    EXPECT_EQ(missing_reason(metrics, "passes"), "");
    EXPECT_NE(missing_reason(metrics, "ldlj"), "") << "not measured then";
    EXPECT_EQ(missing_reason(metrics, "nothing"), "");
  }
}

TEST(MetricResults, TheLastWordCounts) {
  MetricResults first, second;
  first.set("passes", 1.0);
  first.set_missing("strokes", "none");
  second.set_missing("passes", "unknown");
  second.set("strokes", 4.0);
  first.merge(second);
  EXPECT_FALSE(first.value("passes"));
  EXPECT_EQ(*first.value("strokes"), 4.0);
  EXPECT_EQ(first.missing_reason("strokes"), "");
}

}  // namespace
}  // namespace ream::score
