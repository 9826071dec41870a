#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "store/database.hpp"

namespace ream::store {

struct UserRow {
  std::string id;
  std::string name;  ///< to log in with; nobody else has it
  std::string display_name, role, created_utc;
  std::string password_hash;
  bool enabled = true;

  bool operator==(const UserRow&) const = default;
};

/// Users of the server. Thread-safe; errors are those of Database.
class UserTable {
 public:
  /// While there are users, at least one that is enabled has `kept_role`.
  UserTable(Database& database, std::string kept_role)
      : database_(database), kept_role_(std::move(kept_role)) {}

  /// Error conflict when the name is taken, or when the first user has another role than the kept one.
  void add(const UserRow& row);
  /// Changes a user in one transaction; `change` may run more than once. Errors: not_found; conflict when
  /// nobody would be left with the kept role.
  UserRow change(const std::string& id, const std::function<void(UserRow&)>& change);
  /// Errors as for change().
  void remove(const std::string& id);

  std::optional<UserRow> find(const std::string& id) const;
  std::optional<UserRow> find_by_name(const std::string& name) const;
  /// By name.
  std::vector<UserRow> list() const;
  bool any() const;

 private:
  Database& database_;
  const std::string kept_role_;
};

}  // namespace ream::store
