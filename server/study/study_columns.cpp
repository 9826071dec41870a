#include "study/study_columns.hpp"

#include <map>

namespace ream::study {
namespace {

const session::ExportColumn study_column = {"study", "", "Id of the study"};
const session::ExportColumn participant_column = {
    "participant", "", "Code of the participant, drawn at random; it says nothing about the person"};
const session::ExportColumn experience_column = {
    "experience", "", "Level of experience at enrolment: novice, intermediate or expert"};
const session::ExportColumn procedures_column = {
    "procedures_done", "", "Glenoid reamings done in patients before, as stated at enrolment"};

/// Longer endings first: "_n_mm" ends in "_mm" too.
const std::vector<std::pair<std::string, std::string>> units = {
    {"_n_mm", "N/mm"}, {"_mm3", "mm3"},     {"_mm2", "mm2"},  {"_mm_s", "mm/s"}, {"_mm", "mm"},
    {"_nmm", "N mm"},  {"_percent", "%"},   {"_share", "1"},  {"_deg", "deg"},   {"_n", "N"},
    {"_s", "s"},       {"_count", "count"}, {"_scale", "N/N"}};

const std::map<std::string, std::string> metric_words = {
    {"removed_volume_mm3", "Bone removed, without the pilot hole"},
    {"removed_volume_cortical_mm3", "Cortical bone removed"},
    {"removed_volume_cancellous_mm3", "Cancellous bone removed"},
    {"removed_volume_cartilage_mm3", "Cartilage removed"},
    {"reaming_depth_mm", "How far the reamer went along the planned axis from first contact"},
    {"axial_thrust_mean_n", "Mean thrust while in contact with the spindle on, simulated newtons"},
    {"axial_thrust_peak_n", "Largest thrust, simulated newtons"},
    {"apparent_stiffness_n_mm",
     "Thrust gained a mm of advance while thrust first rises; empty when it never rose that far"},
    {"duration_s", "Simulated time of the session"},
    {"contact_time_s", "Time in contact with bone"},
    {"weakened_time_s", "Time in which the hand felt noticeably less than what was simulated"},
    {"force_scale", "Simulated newtons per newton at the hand"}};

std::string unit_of(const std::string& name) {
  for (const auto& [ending, unit] : units)
    if (name.ends_with(ending)) return unit;
  return {};
}

}  // namespace

std::vector<session::ExportColumn> session_columns() {
  return {study_column,
          participant_column,
          experience_column,
          procedures_column,
          {"attempt", "", "1 for the participant's first session in the study, and so on"},
          {"study_day", "day", "Calendar day (UTC) since the participant's first session, which is on day 1"},
          {"case", "", "Id of the case"},
          {"script", "", "Name of the script"},
          {"device", "", "Who held the tool: browser, network, script, ..."},
          {"device_profile", "", "Whose limits the hand felt through"},
          {"state", "", "How it ended: finished, stopped, interrupted or fault"},
          {"given_up", "", "Whether the participant went back to intact bone in another session"}};
}

std::vector<session::ExportColumn> participant_columns() {
  return {study_column,
          participant_column,
          experience_column,
          procedures_column,
          {"answered", "", "Whether the questionnaire was answered"}};
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
  const auto words = metric_words.find(name);
  return {name, unit_of(name),
          words == metric_words.end() ? "As metrics.json of the session has it" : words->second};
}

session::ExportColumn answer_column(const QuestionnaireItem& item) {
  std::string words = item.words;
  switch (item.kind) {
    case QuestionnaireItem::Kind::likert:
      words += " 1: " + item.low + ", " + std::to_string(item.points) + ": " + item.high +
               (item.cannot_judge ? "; empty (null in JSON): cannot judge" : "");
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
