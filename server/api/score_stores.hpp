#pragma once
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "score/benchmark_store.hpp"
#include "score/rubric_store.hpp"
#include "session/scoring/score_document.hpp"

namespace ream::api {

/// Rubrics and benchmarks of a data folder.
struct ScoreStores {
  score::RubricStore rubrics;
  score::BenchmarkStore benchmarks;
  bool writable = true;             ///< false: there is no data folder
  mutable std::mutex editing = {};  ///< one writer of rubrics at a time

  /// "id" or "id@version"; empty: the newest standard one. Errors: not_found; invalid_input for a damaged
  /// one.
  session::Judge judge_by(const std::string& rubric, const std::string& benchmark = {}) const;
};

/// A rubric that a client sends: it asks only for what every session can say. Errors: invalid_input;
/// RequestError 422 with the place of an unknown metric.
score::Rubric requested_rubric(const nlohmann::json& body);

}  // namespace ream::api
