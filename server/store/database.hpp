#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>

namespace soci {
class session;
}

namespace ream::store {

/// A connection inside a transaction. Repositories include store/sql.hpp to use it; nobody else does.
using Sql = soci::session;

struct DatabaseLimits {
  size_t connections = 4;  ///< open at once
  /// How long one waits for a free connection, or for SQLite's one writer.
  std::chrono::milliseconds timeout{5000};
  std::chrono::milliseconds statement{10000};  ///< longest time of one statement (PostgreSQL)
  /// Longest time of one transaction, after which the server is taken to hang (PostgreSQL).
  std::chrono::milliseconds transaction{15000};
  /// After it could not be reached, requests fail at once for this long before it is tried again.
  std::chrono::milliseconds pause{500};
};

/// The database behind all repositories of this room: SQLite or PostgreSQL. Thread-safe. Nothing but tables
/// of the migrations (store/migrations.hpp) is kept in it, with times as "2026-01-31T12:00:00Z" and texts in
/// UTF-8 without NUL.
class Database {
 public:
  /// `url` as for parse_database_url(). A SQLite file is made, private to this user, if need be. Brings the
  /// tables up to date. Errors: usage; unavailable when it cannot be reached; conflict when a newer build has
  /// changed its tables; io.
  explicit Database(const std::string& url, DatabaseLimits limits = {});
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// Runs `action(Sql&)` in one transaction and returns what it returns. All or nothing: an exception undoes
  /// it. Transactions behave as if they ran one after another; where the database cannot do that, or a
  /// connection was lost before the end, the action runs again, so it must change nothing but the database.
  /// Never inside another run() or read(). Errors: unavailable when the database cannot be reached now (the
  /// next call tries again), conflict for a key that is taken or a row that is needed elsewhere, io.
  template <typename Action>
  auto run(Action&& action) {
    return returned(Access::write, std::forward<Action>(action));
  }
  /// As run() for an action that only reads. It sees one state, and waits for no writer.
  template <typename Action>
  auto read(Action&& action) {
    return returned(Access::read, std::forward<Action>(action));
  }
  /// The same without a limit of time, for a program that has nothing else to do.
  template <typename Action>
  auto run_at_length(Action&& action) {
    return returned(Access::long_write, std::forward<Action>(action));
  }
  template <typename Action>
  auto read_at_length(Action&& action) {
    return returned(Access::long_read, std::forward<Action>(action));
  }

  /// For people: "sqlite:FILE" or "postgresql://host:port/name", without user and password.
  const std::string& name() const;

 private:
  enum class Access { read, write, long_read, long_write };
  class Connections;
  void transact(Access access, const std::function<void(Sql&)>& action);

  template <typename Action>
  auto returned(Access access, Action&& action) {
    using Result = std::invoke_result_t<Action&, Sql&>;
    if constexpr (std::is_void_v<Result>) {
      transact(access, action);
    } else {
      std::optional<Result> result;
      transact(access, [&](Sql& sql) { result.emplace(action(sql)); });
      return std::move(*result);
    }
  }

  std::unique_ptr<Connections> connections_;
};

}  // namespace ream::store
