#pragma once
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "score/benchmark.hpp"
#include "score/rubric_score.hpp"

namespace ream::session {

/// What a session is judged by.
struct Judge {
  score::Rubric rubric;
  std::string rubric_id;  ///< among the rubrics of the data folder; empty: not there
  std::shared_ptr<const score::Benchmark> benchmark = nullptr;  ///< null: none
  bool by_plugin = true;  ///< by the score of a plug-in, too, where there is one
};

/// score.json (proto/score.schema.json): what a session is worth by a rubric, with the rubric itself, so that
/// it can be read when the rubric has changed since. `scored_by`: program and version; `session`: its
/// session.json. Error invalid_input when the rubric names a metric that there is not.
nlohmann::json score_document(const std::string& scored_by, const nlohmann::json& session,
                              const nlohmann::json& metrics, const Judge& judge);

/// Score of openapi.yaml but for the session's id and how it stands: every metric of the catalogue with its
/// definition, unit, source, confidence and limits, and the mark. `document`: as above.
nlohmann::json explained_score(const nlohmann::json& document);

/// Writes metrics.json and score.json of a session that has ended, each atomically. Errors: conflict, with
/// the folder as it was, when `metrics` say less than what lies there (its case is gone), or when its score
/// is another plug-in's; io.
void write_results(const std::filesystem::path& folder, const nlohmann::json& metrics,
                   const nlohmann::json& document);

/// Judges a session that has ended by the newest `standard` rubric of the data folder, and writes its
/// score.json from its session.json and metrics.json. What fails is logged: a session's end does not depend
/// on it.
void keep_score(const std::filesystem::path& folder, const std::filesystem::path& data) noexcept;

}  // namespace ream::session
