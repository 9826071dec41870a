#include "score/benchmark.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/json_reader.hpp"
#include "statistics/sample.hpp"

namespace ream::score {
namespace {

/// Metrics are rounded to 1e-6 of their unit (MetricResults::set); nearer to the mean is at the mean.
constexpr double half_rounding = 5e-7;

using nlohmann::json;
using statistics::Spread;
using statistics::spread_of;

/// One expert's value of a metric.
struct ExpertValue {
  std::string session;
  double value = 0.0;
};

std::vector<ExpertValue> values_in(const std::vector<EndedSession>& sessions, std::string_view metric) {
  std::vector<ExpertValue> found;
  for (const EndedSession& session : sessions)
    if (const auto value = session.value(metric)) found.push_back({session.id, *value});
  return found;
}

std::vector<double> numbers_of(const std::vector<ExpertValue>& found) {
  std::vector<double> values;
  for (const ExpertValue& each : found) values.push_back(each.value);
  return values;
}

Spread spread_of_any(const std::vector<double>& values) {
  return values.size() > 1 ? spread_of(values) : Spread{values.front(), 0.0};
}

BenchmarkLine line_of(const std::string& metric, Better better, std::vector<ExpertValue> values) {
  BenchmarkLine line;
  line.metric = metric;
  line.better = better;
  const Spread all = spread_of_any(numbers_of(values));
  const auto far = [&](const ExpertValue& each) {
    return std::abs(each.value - all.mean) > dropped_from_z * all.sd;
  };
  if (all.sd > 0.0) {
    for (const ExpertValue& each : values)
      if (far(each)) line.dropped.push_back(each.session);
    values.erase(std::remove_if(values.begin(), values.end(), far), values.end());
  }
  const Spread left = spread_of_any(numbers_of(values));
  line.mean = left.mean;
  line.sd = left.sd;
  line.experts = static_cast<int>(values.size());
  return line;
}

BenchmarkLine line_from(JsonReader& reader) {
  BenchmarkLine line;
  line.metric = reader.text("metric");
  const std::string better = reader.text("better");
  if (better != "less" && better != "more") reader.refuse("better", "must be less or more");
  line.better = better == "less" ? Better::less : Better::more;
  line.mean = reader.number("mean");
  line.sd = reader.number_or("sd", 0.0, 0.0);
  line.experts = static_cast<int>(reader.integer_or("experts", 1, 1, 1'000'000));
  line.dropped = reader.texts_or_none("dropped");
  reader.finish();
  return line;
}

}  // namespace

Benchmark make_benchmark(const std::string& name, const std::vector<EndedSession>& experts) {
  if (experts.empty())
    throw Error(ErrorKind::invalid_input, "benchmark '" + name + "': no expert's session is given");
  Benchmark benchmark;
  benchmark.name = name;
  for (const EndedSession& session : experts) benchmark.sessions.push_back(session.id);
  for (const Metric& metric : metric_catalogue()) {
    const std::optional<Better> aim = aim_of(metric);
    if (!aim) continue;
    std::vector<ExpertValue> values = values_in(experts, metric.key);
    if (!values.empty()) benchmark.lines.push_back(line_of(std::string(metric.key), *aim, std::move(values)));
  }
  return benchmark;
}

Benchmark load_benchmark(const std::filesystem::path& path) {
  return benchmark_from_json(read_json_file(path), path.string());
}

Benchmark benchmark_from_json(const json& value, const std::string& place) {
  JsonReader reader(value, place);
  Benchmark benchmark;
  benchmark.name = reader.text("name");
  benchmark.sessions = reader.texts_or_none("sessions");
  for (JsonReader& entry : reader.objects("metrics")) benchmark.lines.push_back(line_from(entry));
  reader.finish();
  if (benchmark.lines.empty()) reader.refuse("metrics", "must name at least one metric");
  return benchmark;
}

json benchmark_json(const Benchmark& benchmark) {
  json lines = json::array();
  for (const BenchmarkLine& line : benchmark.lines)
    lines.push_back({{"metric", line.metric},
                     {"better", to_text(line.better)},
                     {"mean", line.mean},
                     {"sd", line.sd},
                     {"experts", line.experts},
                     {"dropped", line.dropped}});
  return {{"name", benchmark.name}, {"sessions", benchmark.sessions}, {"metrics", std::move(lines)}};
}

uint64_t benchmark_hash(const Benchmark& benchmark) { return hash_text(benchmark_json(benchmark).dump()); }

std::vector<BenchmarkResult> compare_with(const Benchmark& benchmark, const json& metrics) {
  std::vector<BenchmarkResult> results;
  for (const BenchmarkLine& line : benchmark.lines) {
    BenchmarkResult result{&line, std::nullopt, false};
    if (const auto found = metrics.find(line.metric); found != metrics.end() && found->is_number()) {
      const double value = found->get<double>();
      result.value = value;
      result.reached = line.better == Better::less ? value <= line.mean + half_rounding
                                                   : value >= line.mean - half_rounding;
    }
    results.push_back(result);
  }
  return results;
}

json comparison_json(const Benchmark& benchmark, const json& metrics) {
  json lines = json::array();
  int reached = 0;
  for (const BenchmarkResult& result : compare_with(benchmark, metrics)) {
    reached += result.reached ? 1 : 0;
    lines.push_back({{"metric", result.line->metric},
                     {"better", to_text(result.line->better)},
                     {"mean", result.line->mean},
                     {"value", result.value ? json(*result.value) : json()},
                     {"reached", result.reached}});
  }
  return {{"benchmark", benchmark.name},
          {"hash", to_hex(benchmark_hash(benchmark))},
          {"reached", reached},
          {"of", lines.size()},
          {"metrics", std::move(lines)}};
}

}  // namespace ream::score
