#pragma once
#include <nlohmann/json_fwd.hpp>

#include "net/message.hpp"
#include "study/study_service.hpp"

namespace ream::api {

/// What REST says of a study to its staff and to those who take part.
struct StudyView {
  const study::Study& study;
  bool to_staff = false;
  int64_t participants = 0;  ///< told to staff
  std::string own_code;      ///< of the caller; empty: does not take part
};

nlohmann::json to_json(const StudyView& told);
/// The same without the questionnaire.
nlohmann::json summary_json(const StudyView& told);
nlohmann::json to_json(const study::Participant& participant);
nlohmann::json to_json(const store::PersonRow& person);

/// Bodies of requests. Throw RequestError as RequestBody does.
study::StudyDraft study_draft_in(const net::Request& request);
/// With `person`, a person may be named (user_id or name, not both).
study::NewParticipant new_participant_in(const net::Request& request, bool person);

}  // namespace ream::api
