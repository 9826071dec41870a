#include "app/open_database.hpp"

#include <cstdlib>
#include <set>

#include "access/access_control.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "store/database_url.hpp"
#include "store/migrations.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

std::string default_url(const fs::path& data) { return "sqlite:" + (data / "ream.db").string(); }

bool is_there(const std::string& chosen, const fs::path& data) {
  return store::is_there(store::parse_database_url(database_url(chosen, data)));
}

/// Of the session or case in the data folder that a name means; empty where it means none.
std::string id_of(const std::string& name, const fs::path& data) {
  for (const fs::path& folder : {sessions_folder(data), cases_folder(data)})
    for (const fs::path& named : {fs::path(name), folder / name}) {
      std::error_code failed;
      const fs::path found = fs::canonical(named, failed);
      if (failed) continue;
      const fs::path below = found.lexically_relative(fs::weakly_canonical(folder, failed));
      if (!below.empty() && *below.begin() != ".." && *below.begin() != ".") return *below.begin();
    }
  return {};
}

}  // namespace

std::string database_url(const std::string& chosen, const fs::path& data) {
  if (!chosen.empty()) {
    if (store::parse_database_url(chosen).has_password)
      throw Error(
          ErrorKind::usage,
          "a password in --db can be read by others on this machine; give the address by REAM_DB, or the "
          "password by PGPASSWORD or ~/.pgpass");
    return chosen;
  }
  if (const char* url = std::getenv("REAM_DB"); url != nullptr && *url != '\0') return url;
  return default_url(data);
}

std::shared_ptr<store::Database> open_database(const std::string& chosen, const fs::path& data) {
  const std::string url = database_url(chosen, data);
  if (url == default_url(data)) make_data_folder(data);
  if (const fs::path kept = store::keep_before_migration(url, data); !kept.empty())
    log::info("the database is brought up to date; as it was, it is kept in " + kept.string());
  return std::make_shared<store::Database>(url);
}

access::Actor command_line_actor() {
  return {"", "command line", access::to_text(access::Role::operator_), "", ""};
}

bool has_users(const std::string& chosen, const fs::path& data) {
  if (!is_there(chosen, data)) return false;
  return access::AccessControl(*open_database(chosen, data)).users.any();
}

void note_reading(const std::string& chosen, const fs::path& data, const std::string& action,
                  const std::vector<std::string>& names) {
  std::set<std::string> ids;
  for (const std::string& name : names) ids.insert(id_of(name, data));
  ids.erase("");
  if (ids.empty() || !is_there(chosen, data)) return;
  const auto database = open_database(chosen, data);
  access::AccessControl access_control(*database);
  if (!access_control.users.any()) return;
  for (const std::string& id : ids) access_control.audit.note(command_line_actor(), action, id, "");
}

}  // namespace ream::app
