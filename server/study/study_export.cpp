#include "study/study_export.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <set>

#include "study/study_columns.hpp"

namespace ream::study {
using nlohmann::json;
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

/// Days since 1970 of "2026-01-31T12:00:00Z".
int64_t day_of(const std::string& utc) {
  const auto number = [&](size_t at, size_t length) {
    return utc.size() >= at + length ? std::atoi(utc.substr(at, length).c_str()) : 0;
  };
  const std::chrono::year_month_day date{std::chrono::year(number(0, 4)),
                                         std::chrono::month(static_cast<unsigned>(number(5, 2))),
                                         std::chrono::day(static_cast<unsigned>(number(8, 2)))};
  return date.ok() ? std::chrono::sys_days(date).time_since_epoch().count() : 0;
}

const std::string& created(const session::SessionRecord& session) { return session.request.created_utc; }

/// The participant went back to intact bone in a session of its own.
bool given_up(const session::SessionRecord& session) { return !session.request.followed_by.empty(); }

std::vector<Row> rows_of(const std::vector<Participant>& participants,
                         const std::vector<session::SessionRecord>& sessions,
                         const MetricsOfSession& metrics) {
  std::vector<Row> rows;
  for (const Participant& participant : participants) {
    std::vector<const session::SessionRecord*> own;
    for (const session::SessionRecord& session : sessions)
      if (session.request.participant == participant.code) own.push_back(&session);
    std::stable_sort(own.begin(), own.end(),
                     [](const auto* a, const auto* b) { return created(*a) < created(*b); });
    for (size_t i = 0; i < own.size(); ++i) {
      Row row{&participant, own[i], static_cast<int>(i + 1), 0, {}};
      row.day = static_cast<int>(day_of(created(*own[i])) - day_of(created(*own.front()))) + 1;
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

session::ExportTable sessions_table(const Study& study, const std::vector<Row>& rows) {
  session::ExportTable table{"sessions", session_columns(), {}};
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
    for (const std::string& name : figures) {
      const auto found = row.figures.find(name);
      cells.push_back(found == row.figures.end() ? json(nullptr) : found->second);
    }
    table.rows.push_back(std::move(cells));
  }
  return table;
}

session::ExportTable answers_table(const Study& study, const std::vector<Participant>& participants) {
  session::ExportTable table{"answers", participant_columns(), {}};
  const std::vector<QuestionnaireItem> none;
  const auto& items = study.questionnaire ? study.questionnaire->items : none;
  for (const QuestionnaireItem& item : items) table.columns.push_back(answer_column(item));
  for (const Participant& participant : participants) {
    std::vector<json> cells = {study.id, participant.code, participant.experience,
                               participant.procedures_done, participant.answers.has_value()};
    for (const QuestionnaireItem& item : items)
      cells.push_back(participant.answers && participant.answers->contains(item.id)
                          ? (*participant.answers)[item.id]
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
    const SessionState state = row.session->status.state;
    if (given_up(*row.session) || (state != SessionState::finished && state != SessionState::stopped))
      continue;
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

double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<size_t>(std::floor(place));
  const size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

StudyExport export_of(const Study& study, const std::vector<Participant>& participants,
                      const std::vector<session::SessionRecord>& sessions, const MetricsOfSession& metrics) {
  std::vector<Participant> by_code = participants;
  std::sort(by_code.begin(), by_code.end(), [](const auto& a, const auto& b) { return a.code < b.code; });
  const std::vector<Row> rows = rows_of(by_code, sessions, metrics);
  StudyExport all{
      sessions_table(study, rows), answers_table(study, by_code), {"groups", group_columns(), {}}};
  add_groups(all.groups, study, "metric", groups_of_sessions(rows));
  add_groups(all.groups, study, "answer", groups_of_answers(study, by_code));
  return all;
}

}  // namespace ream::study
