#include "study/study_export.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "statistics/sample.hpp"
#include "study/study_columns.hpp"
#include "study/study_sessions.hpp"

namespace ream::study {
using nlohmann::json;
using statistics::quantile;
namespace {

using Values = std::map<std::string, json>;

/// Numbers and yes-or-no values of metrics.json; parts of parts as "part.value". Texts are fingerprints of
/// the session and stay behind.
void collect_figures(const json& metrics, const std::string& prefix, Values& figures) {
  for (const auto& [key, value] : metrics.items()) {
    if (value.is_number() || value.is_boolean())
      figures[prefix + key] = value;
    else if (value.is_object())
      collect_figures(value, prefix + key + ".", figures);
  }
}

struct Row {
  const Participant* participant = nullptr;
  const session::SessionRecord* session = nullptr;
  int number = 0, day = 0;
  Values figures;
};

std::vector<Row> rows_of(const std::vector<Participant>& participants,
                         const std::vector<session::SessionRecord>& sessions,
                         const MetricsOfSession& metrics) {
  std::vector<Row> rows;
  for (const Participant& participant : participants) {
    const auto own = sessions_of(participant.code, sessions);
    for (size_t i = 0; i < own.size(); ++i) {
      Row row{&participant, own[i], static_cast<int>(i + 1), 0, {}};
      row.day =
          static_cast<int>(day_of(own[i]->request.created_utc) - day_of(own.front()->request.created_utc)) +
          1;
      collect_figures(metrics(own[i]->request.id), "", row.figures);
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::set<std::string> names_of_figures(const std::vector<Row>& rows) {
  std::set<std::string> names;
  for (const Row& row : rows)
    for (const auto& [name, value] : row.figures) names.insert(name);
  return names;
}

bool designed(const Study& study) { return study.settings.design.has_value(); }

session::ExportTable sessions_table(const Study& study, const std::vector<Row>& rows) {
  session::ExportTable table{"sessions", session_columns(designed(study)), {}};
  const std::set<std::string> figures = names_of_figures(rows);
  for (const std::string& name : figures) table.columns.push_back(metric_column(name));
  for (const Row& row : rows) {
    const session::SessionRequest& request = row.session->request;
    const session::SessionStatus& status = row.session->status;
    std::vector<json> cells = {study.id,
                               row.participant->code,
                               row.participant->experience,
                               row.participant->procedures_done,
                               row.number,
                               row.day,
                               request.case_id,
                               request.script,
                               status.device.name,
                               status.device.profile,
                               to_text(status.state),
                               given_up(*row.session)};
    if (designed(study)) cells.insert(cells.end(), {row.participant->arm, request.phase});
    for (const std::string& name : figures) {
      const auto found = row.figures.find(name);
      cells.push_back(found == row.figures.end() ? json(nullptr) : found->second);
    }
    table.rows.push_back(std::move(cells));
  }
  return table;
}

session::ExportTable answers_table(const Study& study, const std::vector<Participant>& participants) {
  session::ExportTable table{"answers", participant_columns(designed(study)), {}};
  const std::vector<QuestionnaireItem> none;
  const auto& items = study.questionnaire ? study.questionnaire->items : none;
  for (const QuestionnaireItem& item : items) table.columns.push_back(answer_column(item));
  for (const Participant& participant : participants) {
    std::vector<json> cells = {study.id, participant.code, participant.experience,
                               participant.procedures_done, participant.answers.has_value()};
    if (designed(study)) cells.push_back(participant.arm);
    for (const QuestionnaireItem& item : items)
      cells.push_back(participant.answers && participant.answers->contains(item.id)
                          ? (*participant.answers)[item.id]
                          : json(json::value_t::discarded));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

session::ExportTable ratings_table(const Study& study, const std::vector<Row>& rows,
                                   const std::vector<SessionRating>& ratings) {
  session::ExportTable table{"ratings", rating_columns(), {}};
  if (!study.settings.rating_form) return table;
  const auto& items = study.settings.rating_form->items;
  for (const QuestionnaireItem& item : items) table.columns.push_back(answer_column(item));
  std::map<std::string, const Row*> by_id;
  for (const Row& row : rows) by_id[row.session->request.id] = &row;
  for (const SessionRating& rating : ratings) {
    const auto rated = by_id.find(rating.session);
    if (rated == by_id.end()) continue;
    const Row& row = *rated->second;
    std::vector<json> cells = {study.id,    row.participant->code, row.participant->experience,
                               row.number,  row.participant->arm,  row.session->request.phase,
                               rating.rater};
    for (const QuestionnaireItem& item : items)
      cells.push_back(rating.answers.contains(item.id) ? rating.answers[item.id]
                                                       : json(json::value_t::discarded));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

/// Values of the participants of each level, by figure.
using Groups = std::map<std::string, std::map<std::string, std::vector<double>>>;

double plain(const json& value) {
  return value.is_boolean() ? (value.get<bool>() ? 1.0 : 0.0) : value.get<double>();
}

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return quantile(values, 0.5);
}

/// Each participant counts once, with the median of the sessions that were carried to their end.
Groups groups_of_sessions(const std::vector<Row>& rows) {
  std::map<const Participant*, std::map<std::string, std::vector<double>>> own;
  for (const Row& row : rows) {
    if (!carried_out(*row.session)) continue;
    for (const auto& [name, value] : row.figures) own[row.participant][name].push_back(plain(value));
  }
  Groups groups;
  for (const auto& [participant, figures] : own)
    for (const auto& [name, values] : figures)
      groups[participant->experience][name].push_back(median_of(values));
  return groups;
}

Groups groups_of_answers(const Study& study, const std::vector<Participant>& participants) {
  Groups groups;
  if (!study.questionnaire) return groups;
  for (const Participant& participant : participants)
    for (const QuestionnaireItem& item : study.questionnaire->items) {
      if (item.kind != QuestionnaireItem::Kind::likert || !participant.answers) continue;
      const auto answer = participant.answers->find(item.id);
      if (answer != participant.answers->end() && answer->is_number())
        groups[participant.experience][item.id].push_back(plain(*answer));
    }
  return groups;
}

void add_groups(session::ExportTable& table, const Study& study, const std::string& kind, Groups groups) {
  for (const std::string& level : experience_levels)
    for (auto& [name, values] : groups[level]) {
      std::sort(values.begin(), values.end());
      table.rows.push_back({study.id, level, kind, name, values.size(), quantile(values, 0.5),
                            quantile(values, 0.25), quantile(values, 0.75)});
    }
}

}  // namespace

StudyExport export_of(const Study& study, const std::vector<Participant>& participants,
                      const std::vector<session::SessionRecord>& sessions, const MetricsOfSession& metrics,
                      const std::vector<SessionRating>& ratings) {
  std::vector<Participant> by_code = participants;
  std::sort(by_code.begin(), by_code.end(), [](const auto& a, const auto& b) { return a.code < b.code; });
  const std::vector<Row> rows = rows_of(by_code, sessions, metrics);
  StudyExport all{sessions_table(study, rows),
                  answers_table(study, by_code),
                  {"groups", group_columns(), {}},
                  ratings_table(study, rows, ratings)};
  add_groups(all.groups, study, "metric", groups_of_sessions(rows));
  add_groups(all.groups, study, "answer", groups_of_answers(study, by_code));
  return all;
}

}  // namespace ream::study
