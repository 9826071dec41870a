#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "score/benchmark.hpp"

namespace ream::score {

/// What experts reach, and where it comes from.
struct KeptBenchmark {
  std::string id;           ///< given by the store
  std::string created_utc;  ///< given by the store
  score::Benchmark benchmark;
  std::vector<std::string> novices;  ///< sessions that the experts' were contrasted with; may be empty
  std::string rubric, density;       ///< of the cuts, "standard@1" and "normal"; empty without novices
  nlohmann::json cuts = nlohmann::json::array();  ///< as score::group_cuts_json
};

/// The benchmarks of a data folder: <folder>/<id>.json (proto/benchmark.schema.json, as `ream score
/// --benchmark` takes it) and beside it <id>.cuts.json, which one that was put there by hand may lack. Never
/// changed once made. Thread-safe.
class BenchmarkStore {
 public:
  /// Empty: nothing can be kept.
  explicit BenchmarkStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Newest first. What is damaged is left out, with a line in the log.
  std::vector<KeptBenchmark> list() const;
  /// Errors: not_found; invalid_input for a damaged one.
  KeptBenchmark get(const std::string& id) const;
  /// The file of one. Error not_found.
  std::filesystem::path file_of(const std::string& id) const;
  /// As it is kept. Errors: unavailable without a folder; io.
  KeptBenchmark keep(KeptBenchmark wanted) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace ream::score
