#include "study/validity_input.hpp"

#include <analysis.hpp>
#include <optional>
#include <set>

#include "score/metric_catalogue.hpp"
#include "study/study_sessions.hpp"

namespace ream::study {
using nlohmann::json;
namespace {

constexpr int scale_points = 5;

/// Whether all points are by the same rubric, so that they can be compared.
bool by_one_rubric(const std::vector<session::SessionRecord>& sessions) {
  std::set<std::pair<std::string, int>> rubrics;
  for (const session::SessionRecord& session : sessions)
    if (session.mark && session.mark->points) rubrics.emplace(session.mark->rubric, session.mark->version);
  return rubrics.size() <= 1;
}

/// A test beyond those of the design: one that was restored, for instance, after it had been done again.
bool is_surplus(const Study& study, const session::SessionRecord& session, int nth_of_phase) {
  const auto phase = phase_from(session.request.phase);
  if (!study.settings.design || !phase) return false;
  const StudyDesign& design = *study.settings.design;
  switch (*phase) {
    case Phase::pre: return nth_of_phase > design.pre_sessions;
    case Phase::post: return nth_of_phase > design.post_sessions;
    case Phase::retention: return nth_of_phase > design.retention_sessions;
    case Phase::training: return false;
  }
  return false;
}

std::map<std::string, double> measures_of_session(const session::SessionRecord& session, const json& metrics,
                                                  bool with_points) {
  std::map<std::string, double> measures;
  if (with_points && session.mark && session.mark->points) measures["points"] = *session.mark->points;
  for (const auto& [name, value] : metrics.items())
    if (value.is_number() && score::find_metric(name) != nullptr &&
        name.find("_planned_") == std::string::npos)
      measures[name] = value.get<double>();
  return measures;
}

std::optional<ItemKind> kind_of(const QuestionnaireItem& item) {
  if (item.kind == QuestionnaireItem::Kind::likert && item.points == scale_points) return ItemKind::scale;
  if (item.kind == QuestionnaireItem::Kind::choice && !item.several && item.options.size() == 2)
    return ItemKind::check;
  return std::nullopt;
}

/// None for an answer that is missing or "cannot judge".
std::optional<double> value_of(const QuestionnaireItem& item, ItemKind kind, const json& answers) {
  const auto answer = answers.find(item.id);
  if (answer == answers.end() || answer->is_null()) return std::nullopt;
  if (kind == ItemKind::scale)
    return answer->is_number() ? std::optional(answer->get<double>()) : std::nullopt;
  return *answer == item.options.front().id ? 1.0 : 0.0;
}

}  // namespace

ValidityInput validity_input_of(const Study& study, const std::vector<Participant>& participants,
                                const std::vector<session::SessionRecord>& sessions,
                                const MetricsOfSession& metrics, const std::vector<SessionRating>& ratings) {
  const bool one_rubric = by_one_rubric(sessions);
  ValidityInput input;
  std::map<std::string, std::string> codes;  // by session
  for (const Participant& participant : participants) {
    int attempt = 0, counted = 0;
    std::map<std::string, int> done;  // by phase
    for (const session::SessionRecord* session : sessions_of(participant.code, sessions)) {
      ++attempt;
      const json measured = metrics(session->request.id);
      if (!carried_out(*session) || !touched_bone(measured)) continue;
      if (is_surplus(study, *session, ++done[session->request.phase])) continue;
      const std::string code = participant.code + "-" + std::to_string(attempt);
      codes[session->request.id] = code;
      input.sessions.push_back({code, participant.code, participant.experience, participant.arm,
                                session->request.phase, measures_of_session(*session, measured, one_rubric),
                                ++counted});
    }
  }
  if (!study.settings.rating_form) return input;
  for (const QuestionnaireItem& item : study.settings.rating_form->items) {
    const auto kind = kind_of(item);
    if (!kind) continue;
    input.items.push_back({item.id, *kind});
    for (const SessionRating& rating : ratings) {
      const auto code = codes.find(rating.session);
      const auto value = value_of(item, *kind, rating.answers);
      if (code != codes.end() && value)
        input.ratings.push_back({rating.rater, code->second, item.id, *value});
    }
  }
  return input;
}

std::string_view validity_script() { return embedded::analysis::find("validity.R"); }

}  // namespace ream::study
