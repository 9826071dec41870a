#include "api/study_dependencies.hpp"

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/text.hpp"
#include "workup/case_json.hpp"

namespace ream::api {
namespace {

std::optional<study::StudyAttempt> attempt_of(const session::SessionService& sessions,
                                              const session::SessionRecord& record) {
  const session::SessionRequest& request = record.request;
  if (is_live(record.status.state) || record.status.tick == 0) return std::nullopt;
  study::StudyAttempt attempt{request.participant,
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

study::StudyDependencies study_dependencies(const std::filesystem::path& cases_folder,
                                            session::SessionService& sessions,
                                            access::AccessControl& gatehouse) {
  study::StudyDependencies dependencies;
  dependencies.name_of_user = [&gatehouse](const std::string& user_id) -> std::optional<std::string> {
    try {
      const access::User user = gatehouse.users.get(user_id);
      return user.display_name.empty() ? user.name : user.display_name;
    } catch (const Error& unknown) {
      if (unknown.kind() != ErrorKind::not_found) throw;
      return std::nullopt;
    }
  };
  dependencies.has_case = [cases_folder](const std::string& case_id) {
    return is_name(case_id) && workup::is_case_folder(cases_folder / case_id);
  };
  dependencies.attempts = [&sessions](const std::string& study_id) {
    store::SessionQuery query;
    query.study = study_id;
    query.limit = SIZE_MAX;
    std::vector<study::StudyAttempt> attempts;
    for (const session::SessionRecord& record : sessions.list(query).sessions)
      if (auto attempt = attempt_of(sessions, record)) attempts.push_back(std::move(*attempt));
    return attempts;
  };
  return dependencies;
}

}  // namespace ream::api
