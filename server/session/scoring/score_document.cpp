#include "session/scoring/score_document.hpp"

#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/json.hpp"
#include "core/log.hpp"
#include "core/version.hpp"
#include "report/advice.hpp"
#include "score/metric_results.hpp"
#include "score/plugin_score.hpp"
#include "score/rubric_store.hpp"
#include "session/folder/session_folder.hpp"

namespace ream::session {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

/// The rubric's own limits of a metric; null where it says nothing of it.
json criterion_of(const json& document, std::string_view metric) {
  for (const json& criterion : document.at("score").at("criteria"))
    if (criterion.at("metric") == metric) return criterion;
  return nullptr;
}

/// Scores of earlier versions were kept with all their digits.
json shown_points(const json& points) {
  return points.is_number() ? json(score::rounded_points(points.get<double>())) : json();
}

json explained(const score::Metric& metric, const json& document) {
  const json& metrics = document.at("metrics");
  const std::string key(metric.key);
  const auto found = metrics.find(key);
  const bool said = found != metrics.end() && found->is_number();
  const json missing = said ? json(nullptr) : json(score::missing_reason(metrics, key));
  const json criterion = criterion_of(document, metric.key);
  json verdict;
  if (criterion.is_object())
    verdict = criterion.at("verdict");
  else if (const auto judged =
               said ? score::verdict(metric.band, found->get<double>()) : std::optional<score::Verdict>())
    verdict = score::to_text(*judged);
  return {{"metric", key},
          {"name", metric.name},
          {"value", said ? *found : json(nullptr)},
          {"missing", missing},
          {"unsaid", missing},  // the key of the version before
          {"unit", or_null(metric.unit)},
          {"definition", metric.definition},
          {"source", metric.source},
          {"evidence", score::to_text(metric.evidence)},
          {"confidence", metric.confidence},
          {"band", criterion.is_object() ? criterion.at("band") : score::band_json(metric.band)},
          {"verdict", std::move(verdict)},
          {"points", criterion.is_object() ? criterion.at("points") : json(nullptr)},
          {"weight", criterion.is_object() ? criterion.at("weight") : json(nullptr)},
          {"critical", criterion.is_object() && criterion.at("critical").get<bool>()}};
}

/// Empty when it says all that `before` says, but for what a session need not hold: a program may have become
/// stricter about that.
std::string lost_metric(const json& before, const json& metrics) {
  for (const auto& [key, value] : before.items()) {
    const score::Metric* metric = score::find_metric(key);
    if (metric == nullptr || metric->basis == score::Basis::episode) continue;
    if (value.is_number() && !metrics.value(key, json()).is_number()) return key;
  }
  return "";
}

}  // namespace

json score_document(const std::string& scored_by, const json& session, const json& metrics,
                    const Judge& judge) {
  const score::Score score = score::apply_rubric(judge.rubric, metrics);
  json document = {
      {"scored_by", scored_by},
      {"theatre", session.value("theatre", false)},
      {"force_scale", metrics.value("force_scale", 1.0)},
      {"physics", session.value("physics", 1)},
      {"score", score::score_json(judge.rubric, score)},
      {"rubric", score::rubric_json(judge.rubric)},
      {"rubric_id", or_null(judge.rubric_id)},
      {"benchmark", judge.benchmark ? score::comparison_json(*judge.benchmark, metrics) : json()},
      {"metrics", metrics}};
  if (score::offered_plugin_score() && judge.by_plugin) try {
      document["plugin_score"] = score::plugin_score_json(metrics);
    } catch (const Error& e) {
      log::warn("the plug-in could not judge a session: " + std::string(e.what()));
    }
  return document;
}

json explained_score(const json& document) {
  const json& score = document.at("score");
  json metrics = json::array(), advice = json::array();
  for (const score::Metric& metric : score::metric_catalogue())
    metrics.push_back(explained(metric, document));
  for (const report::Advice& each : report::advice_of(score, document.at("metrics")))
    advice.push_back({{"metric", each.metric}, {"words", each.words}, {"lost_points", each.lost_points}});
  return {{"scored_by", document.at("scored_by")},
          {"theatre", document.at("theatre")},
          {"force_scale", document.at("force_scale")},
          {"physics", document.value("physics", 1)},
          {"points", shown_points(score.at("points"))},
          {"said_percent", score.at("said_percent")},
          {"outcome", score.at("outcome")},
          {"reasons", score.at("reasons")},
          {"advice", std::move(advice)},
          {"rubric",
           {{"id", document.value("rubric_id", json())},
            {"version", score.at("version")},
            {"hash", score.at("hash")},
            {"rubric", document.at("rubric")}}},
          {"benchmark", document.at("benchmark")},
          {"metrics", std::move(metrics)}};
}

void write_results(const fs::path& folder, const json& metrics, const json& document) {
  std::error_code failed;
  if (fs::exists(score_json(folder), failed)) score::require_same_plugin(read_json_file(score_json(folder)));
  if (fs::exists(metrics_json(folder), failed)) {
    const json before = read_json_file(metrics_json(folder));
    if (const std::string lost = lost_metric(before, metrics); !lost.empty())
      throw Error(ErrorKind::conflict, "it said " + lost + " before and does not now: " +
                                           score::missing_reason(metrics, lost) + "; it is left as it was");
    if (before != metrics) write_json_file(metrics_json(folder), metrics);
  } else {
    write_json_file(metrics_json(folder), metrics);
  }
  write_json_file(score_json(folder), document);
}

void keep_score(const fs::path& folder, const fs::path& data) noexcept {
  try {
    const score::Rubric rubric = score::RubricStore(rubrics_folder(data)).get("standard");
    write_json_file(score_json(folder),
                    score_document(version_text(), read_json_file(session_json(folder)),
                                   read_json_file(metrics_json(folder)), {rubric, "standard", nullptr}));
  } catch (const std::exception& e) {
    log::warn(folder.string() + ": the session could not be judged: " + e.what());
  }
}

}  // namespace ream::session
