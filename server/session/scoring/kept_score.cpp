#include "session/scoring/kept_score.hpp"

#include "core/data_folder.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "core/version.hpp"
#include "score/rubric_store.hpp"
#include "session/folder/session_folder.hpp"
#include "session/scoring/score_document.hpp"

namespace ream::session {

nlohmann::json score_document(const nlohmann::json& session, const nlohmann::json& metrics,
                              const score::Rubric& rubric, const score::Benchmark* benchmark) {
  auto experts = benchmark ? std::make_shared<const score::Benchmark>(*benchmark) : nullptr;
  return score_document(version_text(), session, metrics, {rubric, "", std::move(experts)});
}

void write_score(const std::filesystem::path& folder, const nlohmann::json& document) {
  write_file_atomically(score_json(folder), document.dump(2) + "\n");
}

void keep_score(const std::filesystem::path& folder, const std::filesystem::path& data) noexcept {
  try {
    const score::Rubric rubric = score::RubricStore(rubrics_folder(data)).get("standard");
    write_score(folder, score_document(version_text(), read_json_file(session_json(folder)),
                                       read_json_file(metrics_json(folder)), {rubric, "standard", nullptr}));
  } catch (const std::exception& e) {
    log::warn(folder.string() + ": the session could not be judged: " + e.what());
  }
}

}  // namespace ream::session
