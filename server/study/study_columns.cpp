#include "study/study_columns.hpp"

#include "score/metric_catalogue.hpp"

namespace ream::study {
namespace {

const session::ExportColumn study_column = {"study", "", "Id of the study"};
const session::ExportColumn participant_column = {
    "participant", "", "Code of the participant, drawn at random; it says nothing about the person"};
const session::ExportColumn experience_column = {
    "experience", "", "Level of experience at enrolment: novice, intermediate or expert"};
const session::ExportColumn procedures_column = {
    "procedures_done", "", "Glenoid reamings done in patients before, as stated at enrolment"};
const session::ExportColumn arm_column = {"arm", "",
                                          "Arm of the study's design, by its id; empty without a design"};
const session::ExportColumn attempt_column = {
    "attempt", "", "1 for the participant's first session in the study, and so on"};
const session::ExportColumn phase_column = {
    "phase", "", "What the session is for in the study's design: pre, training, post or retention"};

}  // namespace

std::vector<session::ExportColumn> session_columns(bool designed) {
  std::vector<session::ExportColumn> columns = {
      study_column,
      participant_column,
      experience_column,
      procedures_column,
      attempt_column,
      {"study_day", "day", "Calendar day (UTC) since the participant's first session, which is on day 1"},
      {"case", "", "Id of the case"},
      {"script", "", "Name of the script"},
      {"device", "", "Who held the tool: browser, network, script, ..."},
      {"device_profile", "", "Whose limits the hand felt through"},
      {"state", "", "How it ended: finished, stopped, interrupted or fault"},
      {"given_up", "", "Whether the participant went back to intact bone in another session"}};
  if (designed) columns.insert(columns.end(), {arm_column, phase_column});
  return columns;
}

std::vector<session::ExportColumn> participant_columns(bool designed) {
  std::vector<session::ExportColumn> columns = {study_column,
                                                participant_column,
                                                experience_column,
                                                procedures_column,
                                                {"answered", "", "Whether the questionnaire was answered"}};
  if (designed) columns.push_back(arm_column);
  return columns;
}

std::vector<session::ExportColumn> rating_columns() {
  return {study_column,
          participant_column,
          experience_column,
          attempt_column,
          arm_column,
          phase_column,
          {"rater", "", "Who rated, as R1, R2, ...; raters were shown neither participant nor score"}};
}

std::vector<session::ExportColumn> group_columns() {
  return {study_column,
          experience_column,
          {"kind", "", "metric: of the sessions; answer: of the questionnaire"},
          {"name", "", "Column of the table of sessions or answers, with its unit"},
          {"n", "",
           "Participants. Each counts once: of a metric with the median of the sessions that ended as "
           "finished or stopped and were not given up, of an answer with its points"},
          {"median", "", "Median over the participants, in the unit of the named column"},
          {"quartile_1", "", "First quartile, linear between neighbours"},
          {"quartile_3", "", "Third quartile, linear between neighbours"}};
}

session::ExportColumn metric_column(const std::string& name) {
  if (const score::Metric* metric = score::find_metric(name))
    return {name, std::string(metric->unit),
            std::string(metric->name) + ". " + std::string(metric->definition)};
  if (name == "force_scale") return {name, "N/N", "Simulated newtons per newton at the hand"};
  return {name, "", "As metrics.json of the session has it"};
}

session::ExportColumn answer_column(const QuestionnaireItem& item) {
  std::string words = item.words;
  switch (item.kind) {
    case QuestionnaireItem::Kind::likert:
      words += " 1: " + item.low + ", " + std::to_string(item.points) + ": " + item.high +
               (item.cannot_judge ? "; empty (null in JSON): cannot say" : "");
      break;
    case QuestionnaireItem::Kind::choice:
      for (const auto& option : item.options) words += " " + option.id + ": " + option.words + ".";
      if (item.several) words += " Several are joined by ';'.";
      break;
    case QuestionnaireItem::Kind::text: words += " Free text."; break;
  }
  return {item.id, item.kind == QuestionnaireItem::Kind::likert ? "points" : "", words};
}

}  // namespace ream::study
