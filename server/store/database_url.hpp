#pragma once
#include <filesystem>
#include <string>

namespace ream::store {

/// Where a database is: "sqlite:FILE" or "postgresql://user@host:port/name" (any URI that libpq knows).
struct DatabaseUrl {
  bool postgresql = false;
  std::filesystem::path file;  ///< of SQLite
  std::string connect;  ///< of PostgreSQL: the URI with limits on how long it may take to notice a loss
  std::string shown;    ///< for people: without user, password and parameters
  bool has_password = false;
};

/// Error usage, which never repeats a password, for anything else.
DatabaseUrl parse_database_url(const std::string& text);

/// Of SQLite whether the file is there, so that nothing is made by looking; one of PostgreSQL is taken to be.
bool is_there(const DatabaseUrl& url);

}  // namespace ream::store
