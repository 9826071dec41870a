#include "app/person_data.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "api/replies.hpp"
#include "app/restore_backup.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/file_lock.hpp"
#include "core/folder_listing.hpp"
#include "core/json.hpp"
#include "session/folder/recorded_annotations.hpp"
#include "session/folder/session_folder.hpp"
#include "session/folder/session_labels.hpp"
#include "store/feel_table.hpp"
#include "store/rating_table.hpp"
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

/// What restoring has moved aside in the data folder.
std::vector<fs::path> folders_aside(const fs::path& data) {
  std::vector<fs::path> folders;
  std::error_code gone;
  for (const fs::path& path : paths_in(data))
    if (path.filename().string().starts_with(moved_aside) && fs::is_directory(path, gone))
      folders.push_back(path);
  return folders;
}

/// In the sessions' folder and the trash, also of what was moved aside.
std::vector<fs::path> session_folders(const fs::path& data) {
  std::vector<fs::path> found, places{data};
  for (const fs::path& aside : folders_aside(data)) places.push_back(aside);
  for (const fs::path& place : places)
    for (const fs::path& sessions : {sessions_folder(place), place / "trash"})
      for (const fs::path& session : paths_in(sessions)) found.push_back(session);
  std::sort(found.begin(), found.end());
  return found;
}

/// By folder.
std::map<fs::path, session::SessionRequest> sessions_of(const access::User& user, const fs::path& data) {
  std::map<fs::path, session::SessionRequest> found;
  for (const fs::path& folder : session_folders(data)) try {
      const session::SessionRecord record = session::read_session_folder(folder);
      if (is_of(user, record.request)) found.emplace(folder, record.request);
    } catch (const Error& failure) {
      if (failure.kind() == ErrorKind::io) throw;  // whose it is cannot be told; others are no session
    }
  return found;
}

bool names_person(const json& row, const access::User& user) {
  return std::any_of(row.begin(), row.end(), [&](const json& cell) {
    if (!cell.is_string()) return false;
    const auto& text = cell.get_ref<const std::string&>();
    return text == user.name || text == user.display_name || text.find(user.id) != std::string::npos ||
           text.find(json(user.display_name).dump()) != std::string::npos;
  });
}

/// Of a table that was moved aside: rows that name the person go; those of the audit log lose who and what.
void forget_rows(const fs::path& file, const access::User& user) {
  std::istringstream in(read_text_file(file));
  std::string line, kept;
  std::getline(in, line);
  const json columns = parse_json_or_discard(line);
  for (kept = line + "\n"; std::getline(in, line);) {
    json row = parse_json_or_discard(line);
    if (!row.is_array() || !names_person(row, user)) {
      kept += line + "\n";
    } else if (file.stem() == "audit") {
      for (size_t i = 0; i < row.size(); ++i)
        if (columns.at(i) == "name" || columns.at(i) == "address" || columns.at(i) == "detail") row[i] = "";
      kept += row.dump() + "\n";
    }
  }
  write_file_atomically(file, kept);
}

void forget_aside(const fs::path& data, const access::User& user, ForgetReport& report) {
  for (const fs::path& aside : folders_aside(data)) {
    for (const fs::path& table : paths_in(aside / "tables")) try {
        forget_rows(table, user);
      } catch (const std::exception& failure) {
        report.left.push_back(table.string() + ": " + failure.what());
      }
  }
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
  for (const fs::path& folder : session_folders(data)) try {
      session::forget_authors(folder, {user.name, user.display_name});
    } catch (const Error& failure) {
      if (failure.kind() != ErrorKind::invalid_input)  // not so damaged that nobody can read remarks in it
        report.left.push_back(folder.string() + ": " + failure.what());
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

json feel_answers_of(store::Database& database, const std::string& study, const std::string& code) {
  json answers = json::array();
  for (const store::FeelAnswerRow& row : store::answers_of(store::FeelTable(database).answers(study), code))
    answers.push_back({{"trial", row.trial},
                       {"chosen", row.chosen},
                       {"session", row.session},
                       {"answered_utc", row.answered_utc}});
  return answers;
}

json ratings_by(store::Database& database, const std::string& study, const std::string& label) {
  json answers = json::array();
  for (const store::RatingRow& row : store::RatingTable(database).ratings(study))
    if (row.rater == label) answers.push_back(parse_json(row.answers));
  return answers;
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
  forget_aside(data, user, report);
  if (!report.left.empty()) return report;
  store::StudyTable(database).forget_person(user.id);
  store::RatingTable(database).forget_user(user.id);
  access_control.users.remove(user.id);
  report.audit_rows = access_control.audit.forget(user.id, {user.name, user.display_name});
  return report;
}

json export_person(store::Database& database, const access::AccessControl& access_control,
                   const fs::path& data, const access::User& user) {
  std::error_code failed;
  if (!fs::is_directory(data, failed))
    throw Error(ErrorKind::not_found, "there is no data folder " + data.string() + "; see --data");
  json sessions = json::array();
  for (const auto& [folder, request] : sessions_of(user, data)) {
    json labels = session::labels_json(request);
    labels["folder"] = fs::relative(folder, data).string();
    labels["created_utc"] = request.created_utc;
    sessions.push_back(std::move(labels));
  }
  json studies = json::array();
  for (const auto& [study, code] : store::StudyTable(database).codes_of(user.id))
    studies.push_back(
        {{"study", study}, {"participant", code}, {"feel_answers", feel_answers_of(database, study, code)}});
  json rated = json::array();
  for (const auto& [study, label] : store::RatingTable(database).labels_of(user.id))
    rated.push_back({{"study", study}, {"rater", label}, {"ratings", ratings_by(database, study, label)}});
  return {{"user", api::user_json(user)},      {"credentials", credentials_json(access_control, user)},
          {"sessions", std::move(sessions)},   {"studies", std::move(studies)},
          {"rated_studies", std::move(rated)}, {"audit", audit_json(access_control.audit, user)}};
}

}  // namespace ream::app
