#include "score/benchmark.hpp"

#include <gtest/gtest.h>

#include "core/file.hpp"
#include "support/expect_error.hpp"
#include "support/json_schema.hpp"
#include "support/places.hpp"

namespace ream::score {
namespace {

using test::expect_error;

std::vector<EndedSession> experts(const char* metric, const std::vector<double>& values) {
  std::vector<EndedSession> sessions;
  for (size_t i = 0; i < values.size(); ++i)
    sessions.push_back({"expert-" + std::to_string(i + 1), nullptr, {{metric, values[i]}}});
  return sessions;
}

const BenchmarkLine& only_line(const Benchmark& benchmark) { return benchmark.lines.at(0); }

TEST(Benchmark, IsTheMeanOfExperts) {
  const Benchmark b = make_benchmark("ours", experts("duration_s", {10.0, 20.0, 60.0}));
  EXPECT_EQ(b.sessions.size(), 3u);
  EXPECT_EQ(b.lines.size(), 1u);
  EXPECT_DOUBLE_EQ(only_line(b).mean, 30.0);
  EXPECT_DOUBLE_EQ(only_line(b).sd, std::sqrt(700.0));
  EXPECT_EQ(only_line(b).experts, 3);
  EXPECT_EQ(only_line(b).better, Better::less);
}

/// The farthest of seven values where six are equal: z is (n - 1) / sqrt(n) = 2.27.
TEST(Benchmark, DropsExpertsFarFromTheOthers) {
  const Benchmark b = make_benchmark("ours", experts("seating_percent", {90, 90, 90, 90, 90, 90, 20}));
  EXPECT_EQ(only_line(b).dropped, std::vector<std::string>{"expert-7"});
  EXPECT_DOUBLE_EQ(only_line(b).mean, 90.0);
  EXPECT_DOUBLE_EQ(only_line(b).sd, 0.0);
  EXPECT_EQ(only_line(b).experts, 6);
  EXPECT_EQ(only_line(b).better, Better::more);
  // Of five, none can be farther than 4 / sqrt(5) = 1.79 standard deviations.
  EXPECT_TRUE(
      only_line(make_benchmark("few", experts("seating_percent", {90, 90, 90, 90, 20}))).dropped.empty());
}

TEST(Benchmark, DropsByTheStandardDeviationOfAll) {
  // Values about 0 whose outermost are just under and just over 1.96 standard deviations away.
  const auto dropped = [](double outer) {
    std::vector<double> values = {-outer, outer};
    for (int i = 0; i < 5; ++i) {
      values.push_back(-1.0);
      values.push_back(1.0);
    }
    return only_line(make_benchmark("b", experts("sparc", values))).dropped.size();
  };
  // z = outer / sqrt((2 outer^2 + 10) / 11) = 1.96 where outer^2 = 38.416 / (11 - 7.6832), outer = 3.4034.
  EXPECT_EQ(dropped(3.39), 0u);
  EXPECT_EQ(dropped(3.42), 2u);
}

TEST(Benchmark, LeavesOutWhatIsNoAchievement) {
  for (const char* metric : {"version_planned_deg", "removed_volume_mm3", "axial_thrust_mean_n", "strokes"}) {
    ASSERT_NE(find_metric(metric), nullptr) << metric;
    EXPECT_FALSE(aim_of(*find_metric(metric))) << metric;
  }
  EXPECT_EQ(aim_of(*find_metric("sparc")), Better::more);
  EXPECT_EQ(aim_of(*find_metric("version_error_deg")), Better::less);
  EXPECT_TRUE(make_benchmark("none", experts("version_planned_deg", {1.0})).lines.empty());
  expect_error(ErrorKind::invalid_input, "no expert", [] { make_benchmark("none", {}); });
}

TEST(Benchmark, EveryMetricWithAnAimIsOneOfTheCatalogue) {
  int aims = 0;
  for (const Metric& metric : metric_catalogue())
    if (metric.band.better == Better::report_only && aim_of(metric)) ++aims;
  EXPECT_EQ(aims, 26) << "a name in the list of aims is not in the catalogue any more";
}

TEST(Benchmark, IsReachedAtTheMeanOrBetter) {
  Benchmark b;
  b.lines = {{"duration_s", Better::less, 30.0, 0, 1, {}},
             {"sparc", Better::more, -2.0, 0, 1, {}},
             {"ldlj", Better::more, -8.0, 0, 1, {}}};
  const auto results = compare_with(b, {{"duration_s", 30.0}, {"sparc", -2.1}, {"ldlj", nullptr}});
  EXPECT_TRUE(results[0].reached);
  EXPECT_FALSE(results[1].reached);
  EXPECT_FALSE(results[2].reached);
  EXPECT_FALSE(results[2].value);
  const nlohmann::json told = comparison_json(b, {{"duration_s", 30.0}, {"sparc", -2.1}, {"ldlj", nullptr}});
  EXPECT_EQ(told["reached"], 1);
  EXPECT_EQ(told["of"], 3);
}

TEST(Benchmark, IsReachedByExpertsWhoAreAllAlike) {
  for (const double value : {0.1, 0.7, 1.988425, 0.017968, 33.333333})
    for (const char* metric : {"duration_s", "seating_percent"}) {
      const Benchmark b = make_benchmark("alike", experts(metric, {value, value, value}));
      EXPECT_TRUE(compare_with(b, {{metric, value}})[0].reached) << metric << " " << value;
    }
}

TEST(Benchmark, IsWrittenAsItIsRead) {
  const Benchmark b = make_benchmark("ours", experts("seating_percent", {90, 91, 92, 90, 90, 90, 20}));
  const nlohmann::json written = benchmark_json(b);
  EXPECT_EQ(benchmark_json(benchmark_from_json(written, "b")), written);
  EXPECT_EQ(benchmark_hash(benchmark_from_json(written, "b")), benchmark_hash(b));
  const nlohmann::json schema = read_json_file(test::source_folder() + "/proto/benchmark.schema.json");
  EXPECT_EQ(test::schema_faults(schema, written), std::vector<std::string>{});
  nlohmann::json bad = written;
  bad["metrics"][0]["better"] = "between";
  expect_error(ErrorKind::invalid_input, "better", [&] { benchmark_from_json(bad, "b"); });
  bad["metrics"] = nlohmann::json::array();
  expect_error(ErrorKind::invalid_input, "metrics", [&] { benchmark_from_json(bad, "b"); });
}

}  // namespace
}  // namespace ream::score
