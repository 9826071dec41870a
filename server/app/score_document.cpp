#include "app/score_document.hpp"

#include "api/score_document.hpp"
#include "api/session_folder.hpp"
#include "app/data_folder.hpp"
#include "app/version.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "score/rubric_store.hpp"

namespace ream::app {

nlohmann::json score_document(const nlohmann::json& session, const nlohmann::json& metrics,
                              const score::Rubric& rubric, const score::Benchmark* benchmark) {
  auto experts = benchmark ? std::make_shared<const score::Benchmark>(*benchmark) : nullptr;
  return api::score_document(version_text(), session, metrics, {rubric, "", std::move(experts)});
}

void write_score(const std::filesystem::path& folder, const nlohmann::json& document) {
  write_file_atomically(api::score_json(folder), document.dump(2) + "\n");
}

void keep_score(const std::filesystem::path& folder, const std::filesystem::path& data) noexcept {
  try {
    const score::Rubric rubric = score::RubricStore(rubrics_folder(data)).get("standard");
    write_score(folder, api::score_document(version_text(), read_json_file(api::session_json(folder)),
                                            read_json_file(api::metrics_json(folder)),
                                            {rubric, "standard", nullptr}));
  } catch (const std::exception& e) {
    log::warn(folder.string() + ": the session could not be judged: " + e.what());
  }
}

}  // namespace ream::app
