#include "study/study_rows.hpp"

#include "core/json.hpp"

namespace ream::study {
using nlohmann::json;

store::StudyRow row_of(const Study& study) {
  const json settings = {
      {"cases", study.settings.cases},
      {"script", study.settings.script},
      {"device", study.settings.device},
      {"device_profile", study.settings.device_profile},
      {"design", study.settings.design ? to_json(*study.settings.design) : json(nullptr)},
      {"feel", study.settings.feel ? to_json(*study.settings.feel) : json(nullptr)},
      {"rating_form", study.settings.rating_form ? to_json(*study.settings.rating_form) : json(nullptr)},
      {"allocation_seed", study.allocation_seed},
      {"rating_key", study.rating_key}};
  return {study.id,
          study.name,
          study.description,
          study.open ? "open" : "closed",
          study.join_code,
          settings.dump(),
          study.questionnaire ? to_json(*study.questionnaire).dump() : std::string(),
          study.created_utc,
          study.closed_utc,
          study.unblinded_utc};
}

Study study_of(const store::StudyRow& row) {
  Study study;
  study.id = row.id;
  study.name = row.name;
  study.description = row.description;
  study.open = row.state == "open";
  study.join_code = row.join_code;
  const json settings = parse_json(row.settings);
  settings.at("cases").get_to(study.settings.cases);
  study.settings.script = settings.value("script", "");
  study.settings.device = settings.value("device", "");
  study.settings.device_profile = settings.value("device_profile", "");
  study.allocation_seed = settings.value("allocation_seed", "");
  study.rating_key = settings.value("rating_key", "");
  if (const json design = settings.value("design", json()); !design.is_null())
    study.settings.design = design_from(design);
  if (const json feel = settings.value("feel", json()); !feel.is_null())
    study.settings.feel = feel_trials_from(feel);
  if (const json form = settings.value("rating_form", json()); !form.is_null())
    study.settings.rating_form = questionnaire_from(form);
  if (!row.questionnaire.empty()) study.questionnaire = questionnaire_from(parse_json(row.questionnaire));
  study.created_utc = row.created_utc;
  study.closed_utc = row.closed_utc;
  study.unblinded_utc = row.unblinded_utc;
  return study;
}

store::ParticipantRow row_of(const std::string& study_id, const Participant& participant) {
  return {participant.code,
          study_id,
          participant.experience,
          participant.procedures_done,
          participant.answers ? participant.answers->dump() : std::string(),
          participant.arm};
}

Participant participant_of(const store::ParticipantRow& row) {
  Participant participant{row.code, row.experience, row.procedures_done, std::nullopt, false, row.arm};
  if (!row.answers.empty()) participant.answers = parse_json(row.answers);
  return participant;
}

}  // namespace ream::study
