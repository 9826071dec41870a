#include "score/benchmark.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/json_reader.hpp"
#include "score/group_density.hpp"

namespace ream::score {
namespace {

/// Metrics are rounded to 1e-6 of their unit (score/findings.hpp); nearer to the mean is at the mean.
constexpr double half_rounding = 5e-7;

using nlohmann::json;

/// Aims of metrics that are reported without limits.
constexpr std::array<std::string_view, 9> less_is_better = {
    "depth_error_mm", "axial_thrust_excess_n_s", "breakthrough_advance_mm", "breakthrough_time_s",   "passes",
    "duration_s",     "contact_time_s",          "path_in_contact_mm",      "path_out_of_contact_mm"};
constexpr std::array<std::string_view, 2> more_is_better = {"sparc", "ldlj"};

/// What one expert's session says of a metric.
struct Said {
  std::string session;
  double value = 0.0;
};

std::vector<Said> all_said(const std::vector<MeasuredSession>& sessions, const std::string& metric) {
  std::vector<Said> result;
  for (const MeasuredSession& session : sessions)
    if (const auto found = session.metrics.find(metric); found != session.metrics.end() && found->is_number())
      result.push_back({session.session, found->get<double>()});
  return result;
}

std::vector<double> values_of(const std::vector<Said>& said) {
  std::vector<double> values;
  for (const Said& each : said) values.push_back(each.value);
  return values;
}

Spread spread_of_any(const std::vector<double>& values) {
  return values.size() > 1 ? spread_of(values) : Spread{values.front(), 0.0};
}

BenchmarkLine line_of(const std::string& metric, Better better, std::vector<Said> said) {
  BenchmarkLine line;
  line.metric = metric;
  line.better = better;
  const Spread all = spread_of_any(values_of(said));
  const auto far = [&](const Said& each) {
    return std::abs(each.value - all.mean) > dropped_from_z * all.sd;
  };
  if (all.sd > 0.0) {
    for (const Said& each : said)
      if (far(each)) line.dropped.push_back(each.session);
    said.erase(std::remove_if(said.begin(), said.end(), far), said.end());
  }
  const Spread left = spread_of_any(values_of(said));
  line.mean = left.mean;
  line.sd = left.sd;
  line.experts = static_cast<int>(said.size());
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

std::string_view to_text(Better better) { return better == Better::less ? "less" : "more"; }

}  // namespace

std::optional<Better> aim_of(const Metric& metric) {
  if (metric.band.better == Better::less || metric.band.better == Better::more) return metric.band.better;
  if (std::find(less_is_better.begin(), less_is_better.end(), metric.key) != less_is_better.end())
    return Better::less;
  if (std::find(more_is_better.begin(), more_is_better.end(), metric.key) != more_is_better.end())
    return Better::more;
  return std::nullopt;
}

Benchmark make_benchmark(const std::string& name, const std::vector<MeasuredSession>& experts) {
  if (experts.empty())
    throw Error(ErrorKind::invalid_input, "benchmark '" + name + "': no expert's session is given");
  Benchmark benchmark;
  benchmark.name = name;
  for (const MeasuredSession& session : experts) benchmark.sessions.push_back(session.session);
  for (const Metric& metric : metric_catalogue()) {
    const std::optional<Better> aim = aim_of(metric);
    if (!aim) continue;
    std::vector<Said> said = all_said(experts, std::string(metric.key));
    if (!said.empty()) benchmark.lines.push_back(line_of(std::string(metric.key), *aim, std::move(said)));
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
