#include "app/open_database.hpp"

#include <cstdlib>

#include "core/error.hpp"
#include "core/file.hpp"
#include "store/database_url.hpp"

namespace ream::app {

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
  return "sqlite:" + (data / "ream.db").string();
}

std::shared_ptr<store::Database> open_database(const std::string& chosen, const std::filesystem::path& data) {
  make_writable_folder(data);
  return std::make_shared<store::Database>(database_url(chosen, data));
}

}  // namespace ream::app
