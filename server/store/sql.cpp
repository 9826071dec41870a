#include "store/sql.hpp"

#include <soci/postgresql/soci-postgresql.h>
#include <soci/sqlite3/soci-sqlite3.h>
#include <algorithm>

#include "core/error.hpp"

namespace ream::store {
namespace {

/// Length of the UTF-8 sequence that begins at `at`, of which the shortest form is demanded; 0 for none.
size_t sequence_length(const std::string& text, size_t at) {
  const auto byte = [&](size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(at), second = byte(at + 1);
  const auto follows = [&](size_t i) { return (byte(at + i) & 0xc0u) == 0x80u; };
  if (first < 0x80) return first == 0 ? 0 : 1;
  if (first >= 0xc2 && first < 0xe0) return follows(1) ? 2 : 0;
  if (first >= 0xe0 && first < 0xf0) {
    const bool shortest = first != 0xe0 || second >= 0xa0, no_surrogate = first != 0xed || second < 0xa0;
    return shortest && no_surrogate && follows(1) && follows(2) ? 3 : 0;
  }
  if (first >= 0xf0 && first < 0xf5) {
    const bool shortest = first != 0xf0 || second >= 0x90, in_range = first != 0xf4 || second < 0x90;
    return shortest && in_range && follows(1) && follows(2) && follows(3) ? 4 : 0;
  }
  return 0;
}

bool is_storable(const std::string& text) {
  for (size_t at = 0; at < text.size();) {
    const size_t length = sequence_length(text, at);
    if (length == 0) return false;
    at += length;
  }
  return true;
}

thread_local bool unstorable = false;

/// The first line, without what libpq and SOCI put before it. Never what(), which has the values too.
std::string message_of(const soci::soci_error& error) {
  std::string message = error.get_error_message();
  for (const std::string_view before : {"failed: ", "Connection failed. ", "FATAL:  ", "ERROR:  "})
    if (const size_t at = message.rfind(before); at != std::string::npos)
      message.erase(0, at + before.size());
  message.erase(std::min(message.find('\n'), message.size()));
  while (!message.empty() && (message.back() == ' ' || message.back() == '.')) message.pop_back();
  return message;
}

Error unreachable(const std::string& database, const std::string& why) {
  return {ErrorKind::unavailable, "the database at " + database + " does not answer (" + why +
                                      "); see that it runs and is reached, then try again"};
}

Error busy(const std::string& database, const std::string& why) {
  return {ErrorKind::unavailable, "the database at " + database + " is busy (" + why + "); try again"};
}

Error contradiction(const std::string& why) {
  return {ErrorKind::conflict, "this contradicts what the database holds already: " + why};
}

Error failed(const std::string& database, const std::string& why) {
  return {ErrorKind::io, "the database at " + database + " fails: " + why};
}

SqlFailure sqlite_failure(const soci::sqlite3_soci_error& error, const std::string& database) {
  const std::string message = message_of(error);
  constexpr int without_detail = 0xff;
  switch (error.result() & without_detail) {
    case SQLITE_BUSY:  // it has been waited for as long as the limits say
    case SQLITE_LOCKED: return {false, false, busy(database, message)};
    case SQLITE_CONSTRAINT: return {false, false, contradiction(message)};
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      return {true,
              false,
              {ErrorKind::io,
               "the database at " + database + " is damaged (" + message +
                   "); restore a backup, or move the file away (sessions are found again in their folders)"}};
    default: return {true, false, failed(database, message)};
  }
}

/// By PostgreSQL's SQLSTATE; its first two letters are the class.
SqlFailure postgresql_failure(const std::string& state, bool lost, const std::string& message,
                              const std::string& database) {
  const std::string kind = state.substr(0, 2);
  if (kind == "40") return {lost, true, busy(database, message)};
  if (kind == "23") return {lost, false, contradiction(message)};
  if (state == "57014" || state == "55P03") return {lost, false, busy(database, message)};
  if (lost || kind == "08" || kind == "57" || kind == "53" || kind == "28" || kind == "3D")
    return {true, false, unreachable(database, message)};
  return {lost, false, failed(database, message)};
}

}  // namespace

const std::string& storable(const std::string& text) {
  static const std::string nothing;
  if (is_storable(text)) return text;
  unstorable = true;
  return nothing;
}

void refuse_unstorable() {
  if (unstorable)
    throw Error(ErrorKind::invalid_input, "a text is no UTF-8, or holds a NUL; the database cannot keep it");
}

void forget_unstorable() { unstorable = false; }

SqlFailure failure_of(const soci::soci_error& error, bool connection_lost, const std::string& database) {
  if (const auto* sqlite = dynamic_cast<const soci::sqlite3_soci_error*>(&error))
    return sqlite_failure(*sqlite, database);
  const auto* postgresql = dynamic_cast<const soci::postgresql_soci_error*>(&error);
  return postgresql_failure(postgresql == nullptr ? "" : postgresql->sqlstate(), connection_lost,
                            message_of(error), database);
}

}  // namespace ream::store
