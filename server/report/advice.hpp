#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace ream::report {

/// What a trainee should do better next time, of one criterion.
struct Advice {
  std::string metric, words;  ///< one sentence that says what to do
  double lost_points = 0.0;   ///< of 100
  bool decides = false;       ///< it is a critical criterion that fails
};

inline constexpr size_t max_advice = 5;

/// The criteria that cost at least a point, or that fail the session: those first, then by what they cost.
/// `score`: as score::score_json() writes it; `metrics`: metrics.json.
std::vector<Advice> advice_of(const nlohmann::json& score, const nlohmann::json& metrics);

}  // namespace ream::report
