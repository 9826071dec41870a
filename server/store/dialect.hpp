#pragma once
#include <memory>
#include <string>
#include <vector>

#include "store/database.hpp"
#include "store/database_url.hpp"

/// What the two stores do differently. Internal to this room.
namespace ream::store {

bool on_postgresql(Sql& sql);

/// A migration's statement in the words of this store.
std::string in_dialect(Sql& sql, std::string statement);

/// Until the end of the transaction no other process migrates.
void lock_for_migration(Sql& sql);

/// Opens a connection and sets it up. Throws what SOCI throws, or Error io when SQLite's file cannot be made.
std::unique_ptr<Sql> open_connection(const DatabaseUrl& url, const DatabaseLimits& limits);

/// A column of a table of ours.
struct Column {
  enum class Kind { text, whole, number };
  std::string name;
  Kind kind = Kind::text;
};
/// In their order in the table.
std::vector<Column> columns_of(Sql& sql, const std::string& table);

/// The table's NUMBERED_KEY goes on behind its largest number.
void advance_identity(Sql& sql, const std::string& table);

void begin_writing(Sql& sql);
void begin_reading(Sql& sql);

/// Until the end of the transaction statements, and what is done between them, may take as long as they need.
void lift_time_limit(Sql& sql);

/// -1 for a database that is no server.
int socket_of(Sql& sql) noexcept;
/// Whether the other end has gone, so that this connection is of no more use.
bool connection_lost(Sql& sql) noexcept;

}  // namespace ream::store
