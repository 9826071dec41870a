#include "score/findings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "score/metric_catalogue.hpp"

namespace ream::score {
namespace {

TEST(Findings, NeverSayWhatIsNoNumber) {
  Findings f;
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    f.say("passes", 2.0);
    f.say("passes", value);
    EXPECT_FALSE(f.said("passes"));
    EXPECT_NE(f.unsaid("passes"), "");
  }
}

TEST(Findings, AreRoundedSoThatOnlyWhatIsMeantShows) {
  Findings f;
  f.say("sparc", -1.4140271);
  EXPECT_EQ(*f.said("sparc"), -1.414027);
  f.say("sparc", -1e-9);
  EXPECT_FALSE(std::signbit(*f.said("sparc")));
}

TEST(Findings, GiveEveryMetricOfTheCatalogueAValueOrAReason) {
  Findings f;
  f.say("seating_percent", 91.0);
  f.leave("congruity_mm", "nothing was reamed");
  f.leave("apparent_stiffness_n_mm", "thrust did not rise");
  nlohmann::json metrics = {{"duration_s", 3.0}, {"apparent_stiffness_n_mm", nullptr}};
  f.write_to(metrics);
  for (const Metric& metric : metric_catalogue()) {
    const std::string key(metric.key);
    ASSERT_TRUE(metrics.contains(key)) << key;
    EXPECT_NE(metrics.at(key).is_null(), !metrics.at("unsaid").contains(key)) << key;
  }
  EXPECT_EQ(metrics["duration_s"], 3.0);
  EXPECT_EQ(metrics["seating_percent"], 91.0);
  EXPECT_EQ(metrics["unsaid"]["congruity_mm"], "nothing was reamed");
  EXPECT_EQ(metrics["unsaid"]["apparent_stiffness_n_mm"], "thrust did not rise");
}

TEST(Findings, TheLastWordCounts) {
  Findings first, second;
  first.say("passes", 1.0);
  first.leave("strokes", "none");
  second.leave("passes", "unknown");
  second.say("strokes", 4.0);
  first.take(second);
  EXPECT_FALSE(first.said("passes"));
  EXPECT_EQ(*first.said("strokes"), 4.0);
  EXPECT_EQ(first.unsaid("strokes"), "");
}

}  // namespace
}  // namespace ream::score
