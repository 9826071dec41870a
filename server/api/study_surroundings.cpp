#include "api/study_surroundings.hpp"

#include <nlohmann/json.hpp>

#include "api/case_json.hpp"
#include "api/request_body.hpp"
#include "core/error.hpp"

namespace ream::api {
namespace {

std::optional<StudyAttempt> attempt_of(const SessionService& sessions, const SessionRecord& record) {
  const SessionRequest& request = record.request;
  if (is_live(record.status.state) || record.status.tick == 0) return std::nullopt;
  StudyAttempt attempt{request.participant,
                       request.case_id,
                       request.script,
                       record.status.device.name,
                       record.status.device.profile,
                       to_text(record.status.state),
                       request.created_utc,
                       !request.followed_by.empty(),
                       nlohmann::json::object()};
  try {
    attempt.metrics = sessions.metrics(request.id);
  } catch (const Error& missing) {
    if (missing.kind() != ErrorKind::not_found) throw;
  }
  return attempt;
}

}  // namespace

StudySurroundings study_surroundings(const std::filesystem::path& cases_folder, SessionService& sessions,
                                     access::AccessControl& gatehouse) {
  StudySurroundings surroundings;
  surroundings.name_of_user = [&gatehouse](const std::string& user_id) -> std::optional<std::string> {
    try {
      const access::User user = gatehouse.users.get(user_id);
      return user.display_name.empty() ? user.name : user.display_name;
    } catch (const Error& unknown) {
      if (unknown.kind() != ErrorKind::not_found) throw;
      return std::nullopt;
    }
  };
  surroundings.has_case = [cases_folder](const std::string& case_id) {
    return is_name(case_id) && is_case_folder(cases_folder / case_id);
  };
  surroundings.attempts = [&sessions](const std::string& study_id) {
    store::SessionQuery query;
    query.study = study_id;
    query.limit = SIZE_MAX;
    std::vector<StudyAttempt> attempts;
    for (const SessionRecord& record : sessions.list(query).sessions)
      if (auto attempt = attempt_of(sessions, record)) attempts.push_back(std::move(*attempt));
    return attempts;
  };
  return surroundings;
}

}  // namespace ream::api
