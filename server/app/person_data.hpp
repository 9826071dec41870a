#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "access/access_control.hpp"
#include "store/database.hpp"

namespace ream::app {

/// Where a data folder and its database hold something of a person, and what forgetting makes of it:
/// - users, credentials: removed
/// - labels of sessions and trash: the name becomes "forgotten"; the id, which stands for nobody then, stays
/// - remarks in recordings: without author; their words stay
/// - index of sessions: removed with the old labels; the next server reads the folders again
/// - audit log: name, address and detail taken out; ids stay, and the chain holds
/// - answers kept to be repeated, study_persons: removed; what the participant did stays under its code
/// - study_feel_answers: stay under the code
/// - study_raters: without the person; the ratings stay under the rater's label
/// - before-restore-*: sessions and remarks as above, rows of the person removed, or emptied as the audit log
/// - black boxes: figures only, they name nobody
/// - results of jobs: exports with the old name go by themselves within a day
/// - backups, what was downloaded: stay; they are not in the data folder
struct ForgetReport {
  size_t sessions = 0;
  std::vector<std::string> left;  ///< what could not be changed, for people
  int64_t audit_rows = 0;
};

/// Errors: conflict while a server runs on the data folder, or for the last operator; those of the database.
/// With anything that is left the user stays, disabled, so that it can be done again.
ForgetReport forget_person(store::Database& database, access::AccessControl& access_control,
                           const std::filesystem::path& data, const access::User& user);

/// All of the same places, without what is secret. Reads only.
nlohmann::json export_person(store::Database& database, const access::AccessControl& access_control,
                             const std::filesystem::path& data, const access::User& user);

}  // namespace ream::app
