#include "app/person_data.hpp"

#include <map>
#include <nlohmann/json.hpp>

#include "api/replies.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file_lock.hpp"
#include "session/folder/session_folder.hpp"
#include "session/folder/session_labels.hpp"
#include "store/session_index.hpp"
#include "store/study_table.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;
using access::CredentialKind;
using nlohmann::json;

constexpr const char* forgotten_name = "forgotten";
constexpr int audit_rows_at_once = 1000;

/// Sessions of a time without users have a name only.
bool is_of(const access::User& user, const session::SessionRequest& request) {
  if (!request.trainee_id.empty()) return request.trainee_id == user.id;
  return !request.trainee.empty() && (request.trainee == user.name || request.trainee == user.display_name);
}

/// By folder, in the sessions' folder and the trash.
std::map<fs::path, session::SessionRequest> sessions_of(const access::User& user, const fs::path& data) {
  std::map<fs::path, session::SessionRequest> found;
  for (const fs::path& place : {sessions_folder(data), data / "trash"}) {
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(place, failed)) try {
        const session::SessionRecord record = session::read_session_folder(entry.path());
        if (is_of(user, record.request)) found.emplace(entry.path(), record.request);
      } catch (const Error&) {  // no session, or one that nobody can read
      }
  }
  return found;
}

void forget_sessions(store::Database& database, const fs::path& data, const access::User& user,
                     ForgetReport& report) {
  std::vector<std::string> changed;
  for (auto& [folder, request] : sessions_of(user, data)) {
    if (request.trainee == forgotten_name) continue;
    request.trainee = forgotten_name;
    try {
      session::relabel_folder(folder, request);
      changed.push_back(folder.filename().string());
    } catch (const Error& failure) {
      report.left.push_back(folder.string() + ": " + failure.what());
    }
  }
  report.sessions = changed.size();
  store::SessionIndex(database).remove(changed);
}

json credentials_json(const access::AccessControl& access_control, const access::User& user) {
  json all = json::array();
  for (const CredentialKind kind : {CredentialKind::token, CredentialKind::link, CredentialKind::cookie})
    for (const auto& row : access_control.credentials.list(kind, user.id))
      all.push_back({{"kind", row.kind},
                     {"id", row.id},
                     {"name", row.name},
                     {"created_utc", row.created_utc},
                     {"expires_utc", row.expires_utc},
                     {"last_used_utc", row.last_used_utc}});
  return all;
}

json audit_json(const access::AuditLog& audit, const access::User& user) {
  json rows = json::array();
  int64_t after = 0;
  for (auto some = audit.list_from(after, audit_rows_at_once); !some.empty();
       some = audit.list_from(after, audit_rows_at_once))
    for (const store::AuditRow& row : some) {
      after = row.number;
      if (row.user_id == user.id || row.object == user.id)
        rows.push_back({{"number", row.number},
                        {"at_utc", row.at_utc},
                        {"address", row.user_id == user.id ? row.address : ""},
                        {"action", row.action},
                        {"object", row.object},
                        {"detail", row.detail}});
    }
  return rows;
}

}  // namespace

ForgetReport forget_person(store::Database& database, access::AccessControl& access_control,
                           const fs::path& data, const access::User& user) {
  const auto alone = FileLock::attempt(serving_lock(data));
  if (!alone)
    throw Error(ErrorKind::conflict, "a server runs on " + data.string() + "; stop it, then forget");
  access::UserChange disabled;
  disabled.enabled = false;
  access_control.users.change(user.id, disabled);
  ForgetReport report;
  forget_sessions(database, data, user, report);
  if (!report.left.empty()) return report;
  store::StudyTable(database).forget_person(user.id);
  access_control.users.remove(user.id);
  report.audit_rows = access_control.audit.forget(user.id, {user.name, user.display_name});
  return report;
}

json export_person(store::Database& database, const access::AccessControl& access_control,
                   const fs::path& data, const access::User& user) {
  json sessions = json::array();
  for (const auto& [folder, request] : sessions_of(user, data)) {
    json labels = session::labels_json(request);
    labels["folder"] = fs::relative(folder, data).string();
    labels["created_utc"] = request.created_utc;
    sessions.push_back(std::move(labels));
  }
  json studies = json::array();
  for (const auto& [study, code] : store::StudyTable(database).codes_of(user.id))
    studies.push_back({{"study", study}, {"participant", code}});
  return {{"user", api::user_json(user)},
          {"credentials", credentials_json(access_control, user)},
          {"sessions", std::move(sessions)},
          {"studies", std::move(studies)},
          {"audit", audit_json(access_control.audit, user)}};
}

}  // namespace ream::app
