#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace ream::score {

/// A session's id and its metrics.json.
struct MeasuredSession {
  std::string session;
  nlohmann::json metrics;
};

}  // namespace ream::score
