#include "store/sql_failure.hpp"

#include <soci/postgresql/soci-postgresql.h>
#include <soci/sqlite3/soci-sqlite3.h>

#include <algorithm>

namespace ream::store {
namespace {

/// The first line, without what libpq and SOCI put before it. Never what(), which has the values too.
std::string words_of(const soci::soci_error& error) {
  std::string words = error.get_error_message();
  for (const std::string_view before : {"failed: ", "Connection failed. ", "FATAL:  ", "ERROR:  "})
    if (const size_t at = words.rfind(before); at != std::string::npos) words.erase(0, at + before.size());
  words.erase(std::min(words.find('\n'), words.size()));
  while (!words.empty() && (words.back() == ' ' || words.back() == '.')) words.pop_back();
  return words;
}

Error away(const std::string& database, const std::string& why) {
  return {ErrorKind::unavailable, "the database at " + database + " does not answer (" + why +
                                      "); see that it runs and is reached, then try again"};
}

Error busy(const std::string& database, const std::string& why) {
  return {ErrorKind::unavailable, "the database at " + database + " is busy (" + why + "); try again"};
}

Error taken(const std::string& why) {
  return {ErrorKind::conflict, "this contradicts what the database holds already: " + why};
}

Error failed(const std::string& database, const std::string& why) {
  return {ErrorKind::io, "the database at " + database + " fails: " + why};
}

SqlFailure sqlite_failure(const soci::sqlite3_soci_error& error, const std::string& database) {
  const std::string words = words_of(error);
  constexpr int without_detail = 0xff;
  switch (error.result() & without_detail) {
    case SQLITE_BUSY:  // it has been waited for as long as the limits say
    case SQLITE_LOCKED:
      return {false, false, busy(database, words)};
    case SQLITE_CONSTRAINT:
      return {false, false, taken(words)};
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      return {true,
              false,
              {ErrorKind::io,
               "the database at " + database + " is damaged (" + words +
                   "); restore a backup, or move the file away (sessions are found again in their folders)"}};
    default:
      return {true, false, failed(database, words)};
  }
}

/// By PostgreSQL's SQLSTATE; its first two letters are the class.
SqlFailure postgresql_failure(const std::string& state, bool lost, const std::string& words,
                              const std::string& database) {
  const std::string kind = state.substr(0, 2);
  if (kind == "40") return {lost, true, busy(database, words)};
  if (kind == "23") return {lost, false, taken(words)};
  if (state == "57014" || state == "55P03") return {lost, false, busy(database, words)};
  if (lost || kind == "08" || kind == "57" || kind == "53" || kind == "28" || kind == "3D")
    return {true, false, away(database, words)};
  return {lost, false, failed(database, words)};
}

}  // namespace

SqlFailure failure_of(const soci::soci_error& error, bool connection_lost, const std::string& database) {
  if (const auto* sqlite = dynamic_cast<const soci::sqlite3_soci_error*>(&error))
    return sqlite_failure(*sqlite, database);
  const auto* postgresql = dynamic_cast<const soci::postgresql_soci_error*>(&error);
  return postgresql_failure(postgresql == nullptr ? "" : postgresql->sqlstate(), connection_lost,
                            words_of(error), database);
}

}  // namespace ream::store
