#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace ream::score {

/// A session that has ended, for statistics. Who needs only its metrics leaves the rest empty.
struct EndedSession {
  std::string id;
  nlohmann::json session = nullptr;  ///< session.json, or what its recording says of it
  nlohmann::json metrics = nullptr;  ///< metrics.json; null: not read, or not left
  std::filesystem::path folder = {};

  /// Of its metrics; empty: it is missing.
  std::optional<double> value(std::string_view metric) const {
    const auto found = metrics.find(std::string(metric));
    if (found == metrics.end() || !found->is_number()) return std::nullopt;
    return found->get<double>();
  }
};

}  // namespace ream::score
