#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "score/ended_session.hpp"
#include "score/metric_catalogue.hpp"

namespace ream::score {

/// What experts reach in one metric.
struct BenchmarkLine {
  std::string metric;
  Better better = Better::less;      ///< less or more
  double mean = 0.0, sd = 0.0;       ///< of the experts that count; sd (n - 1) is 0 for a single one
  int experts = 0;                   ///< that count
  std::vector<std::string> dropped;  ///< sessions whose |z| in this metric is over dropped_from_z
};

/// Proficiency-based progression: the mean of experts, metric by metric, is what a trainee has
/// to reach. A file of proto/benchmark.schema.json.
struct Benchmark {
  std::string name;
  std::vector<std::string> sessions;  ///< of the experts
  std::vector<BenchmarkLine> lines;
};

/// Experts farther than this from the mean of all, in standard deviations of all, are left out. The farthest
/// of n values can be (n - 1) / sqrt(n) away, so that this needs six experts or more.
inline constexpr double dropped_from_z = 1.96;

/// Over all metrics that have an aim and that an expert's session has. Error invalid_input when there is no
/// session.
Benchmark make_benchmark(const std::string& name, const std::vector<EndedSession>& experts);

/// Error not_found, invalid_input (names file and key).
Benchmark load_benchmark(const std::filesystem::path& path);
Benchmark benchmark_from_json(const nlohmann::json& value, const std::string& place);
nlohmann::json benchmark_json(const Benchmark& benchmark);
uint64_t benchmark_hash(const Benchmark& benchmark);

struct BenchmarkResult {
  const BenchmarkLine* line = nullptr;  ///< of the benchmark, which must outlive this
  std::optional<double> value;          ///< empty: missing
  bool reached = false;
};

/// Line by line.
std::vector<BenchmarkResult> compare_with(const Benchmark& benchmark, const nlohmann::json& metrics);

/// Name, hash, how many lines are reached, and each of them.
nlohmann::json comparison_json(const Benchmark& benchmark, const nlohmann::json& metrics);

}  // namespace ream::score
