#include "app/open_database.hpp"

#include <cstdlib>

#include "access/access_control.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "store/database_url.hpp"

namespace ream::app {
namespace {

std::string default_url(const std::filesystem::path& data) { return "sqlite:" + (data / "ream.db").string(); }

}  // namespace

std::string database_url(const std::string& chosen, const std::filesystem::path& data) {
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

std::shared_ptr<store::Database> open_database(const std::string& chosen, const std::filesystem::path& data) {
  const std::string url = database_url(chosen, data);
  if (url == default_url(data)) make_data_folder(data);
  return std::make_shared<store::Database>(url);
}

access::Actor command_line_actor() {
  return {"", "command line", access::to_text(access::Role::operator_), "", ""};
}

bool has_users(const std::string& chosen, const std::filesystem::path& data) {
  const store::DatabaseUrl url = store::parse_database_url(database_url(chosen, data));
  std::error_code failed;
  if (!url.postgresql && !std::filesystem::exists(url.file, failed)) return false;
  return access::AccessControl(*open_database(chosen, data)).users.any();
}

}  // namespace ream::app
