#include "session/scoring/score_table.hpp"

#include "score/band.hpp"

namespace ream::session {
namespace {

using nlohmann::json;

/// Columns before those of the metrics, in the order of session_cells().
std::vector<ExportColumn> session_columns() {
  return {{"session", "", "Id of the session"},
          {"trainee", "", "Code of the participant, else id of the user who trained"},
          {"created_utc", "", "When the session was made"},
          {"attempt", "", "1, or more after resets"},
          {"case", "", "Id of the case"},
          {"side", "", "left or right shoulder"},
          {"device", "", "Who held the tool: script, browser, network, ..."},
          {"device_profile", "", "Whose limits the hand felt through"},
          {"force_scale", "N/N", "Simulated newtons per newton at the hand"},
          {"theatre", "", "Whether nothing but the bone was shown while reaming"},
          {"state", "", "How it ended: finished, stopped, fault or interrupted"},
          {"rubric", "", "By which the result was found, with its version"},
          {"outcome", "", "pass, fail or undecided"},
          {"points", "", "Of 100"},
          {"said_percent", "%", "Share of the rubric's weights that the points rest on"}};
}

json text_or_null(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? *found : json();
}

std::string code_of(const json& session) {
  for (const char* key : {"participant", "trainee_id"})
    if (const std::string code = session.value(key, ""); !code.empty()) return code;
  return "";
}

std::vector<json> session_cells(const EndedSession& one, const score::Rubric& rubric) {
  const score::Score score = score::apply_rubric(rubric, one.metrics);
  const std::string code = code_of(one.session);
  return {one.id,
          code.empty() ? json() : json(code),
          text_or_null(one.session, "created_utc"),
          one.session.value("attempt", 1),
          text_or_null(one.session, "case"),
          text_or_null(one.session, "side"),
          one.session.value("device", "script"),
          text_or_null(one.session, "device_profile"),
          one.metrics.value("force_scale", json()),
          one.session.value("theatre", false),
          one.session.value("state", "finished"),
          rubric.name + " " + std::to_string(rubric.version),
          score.outcome ? json(score::to_text(*score.outcome)) : json(),
          score.points ? json(*score.points) : json(),
          score.measured_percent};
}

std::string limits_in_words(const score::Metric& metric) {
  return metric.band.better == score::Better::report_only ? "" : score::band_json(metric.band).dump();
}

}  // namespace

ExportTable score_table(const std::vector<EndedSession>& sessions, const score::Rubric& rubric) {
  ExportTable table;
  table.name = "sessions";
  table.columns = session_columns();
  for (const score::Metric& metric : score::metric_catalogue())
    table.columns.push_back({std::string(metric.key), std::string(metric.unit),
                             std::string(metric.name) + ". " + std::string(metric.definition)});
  for (const EndedSession& one : sessions) {
    std::vector<json> row = session_cells(one, rubric);
    for (const score::Metric& metric : score::metric_catalogue())
      row.push_back(one.metrics.value(std::string(metric.key), json()));
    table.rows.push_back(std::move(row));
  }
  return table;
}

ExportTable score_codebook(const ExportTable& table) {
  ExportTable book;
  book.name = "codebook";
  book.columns = {{"column", "", "Name"},   {"unit", "", "Unit"},         {"words", "", "What it is"},
                  {"source", "", "Source"}, {"evidence", "", "Evidence"}, {"limits", "", "Limits"}};
  for (const ExportColumn& column : table.columns) {
    const score::Metric* metric = score::find_metric(column.name);
    book.rows.push_back({column.name, column.unit.empty() ? json() : json(column.unit), column.words,
                         metric ? json(metric->source) : json(),
                         metric ? json(score::to_text(metric->evidence)) : json(),
                         metric ? json(limits_in_words(*metric)) : json()});
  }
  return book;
}

}  // namespace ream::session
