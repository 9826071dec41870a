#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "score/benchmark.hpp"
#include "score/rubric_score.hpp"

namespace ream::session {

/// score.json (proto/score.schema.json): what a session is worth by a rubric, with the rubric itself, so that
/// it can be read when the rubric has changed since. `session`: its session.json.
nlohmann::json score_document(const nlohmann::json& session, const nlohmann::json& metrics,
                              const score::Rubric& rubric, const score::Benchmark* benchmark = nullptr);

/// Writes it into a session's folder. Errors: io; invalid_input when the rubric names a metric that there is
/// not.
void write_score(const std::filesystem::path& folder, const nlohmann::json& document);

/// Judges a session that has ended by the newest `standard` rubric of the data folder, and writes its
/// score.json from its session.json and metrics.json. What fails is logged: a session's end does not depend
/// on it.
void keep_score(const std::filesystem::path& folder, const std::filesystem::path& data) noexcept;

}  // namespace ream::session
