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

  struct Added {
    bool first = false;
    std::vector<std::string> ended;  ///< ids of credentials that went with the open beginning
  };
  /// With the first user all credentials without an owner go: whoever made them was not known. Error conflict
  /// when the name is taken, or when the first user has another role than the kept one.
  Added add(const UserRow& row);
  /// Changes a user in one transaction; `change` may run more than once. Errors: not_found; conflict when
  /// nobody would be left with the kept role.
  UserRow change(const std::string& id, const std::function<void(UserRow&)>& change);
  /// With the answers that are kept to repeat for or about the user. Errors as for change().
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
