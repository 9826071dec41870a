#include "app/score_document.hpp"

#include "api/session_folder.hpp"
#include "app/data_folder.hpp"
#include "app/version.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "score/rubric_shelf.hpp"

namespace ream::app {

nlohmann::json score_document(const nlohmann::json& session, const nlohmann::json& metrics,
                              const score::Rubric& rubric, const score::Benchmark* benchmark) {
  return {{"scored_by", version_text()},
          {"theatre", session.value("theatre", false)},
          {"force_scale", metrics.value("force_scale", 1.0)},
          {"score", score::score_json(rubric, score::apply_rubric(rubric, metrics))},
          {"rubric", score::rubric_json(rubric)},
          {"benchmark", benchmark ? score::comparison_json(*benchmark, metrics) : nlohmann::json()},
          {"metrics", metrics}};
}

void write_score(const std::filesystem::path& folder, const nlohmann::json& document) {
  write_file_atomically(folder / "score.json", document.dump(2) + "\n");
}

void keep_score(const std::filesystem::path& folder, const std::filesystem::path& data) noexcept {
  try {
    const score::Rubric rubric = score::RubricShelf(rubrics_folder(data)).get("standard");
    write_score(folder, score_document(read_json_file(api::session_json(folder)),
                                       read_json_file(api::metrics_json(folder)), rubric));
  } catch (const std::exception& e) {
    log::warn(folder.string() + ": the session could not be judged: " + e.what());
  }
}

}  // namespace ream::app
