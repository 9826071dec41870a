#include "store/user_table.hpp"

#include "core/error.hpp"
#include "store/sql.hpp"

namespace ream::store {
namespace {

const std::string columns =
    "SELECT id, name, display_name, role, created_utc, password_hash, enabled FROM users ";

std::optional<UserRow> find_where(Sql& sql, const std::string& condition, const std::string& value) {
  UserRow row;
  int enabled = 0;
  sql << columns + condition, use(value), into(row.id), into(row.name), into(row.display_name),
      into(row.role), into(row.created_utc), into(row.password_hash), into(enabled);
  if (!sql.got_data()) return std::nullopt;
  row.enabled = enabled != 0;
  return row;
}

UserRow known(Sql& sql, const std::string& id) {
  if (auto row = find_where(sql, "WHERE id = :id", id)) return *row;
  throw Error(ErrorKind::not_found, "no user '" + id + "'");
}

void require_some_left(Sql& sql, const std::string& role, const std::string& name) {
  long long left = 0;
  sql << "SELECT COUNT(*) FROM users WHERE enabled = 1 AND role = :role", use(role), into(left);
  if (left == 0)
    throw Error(ErrorKind::conflict,
                "'" + name + "' is the last " + role + " who can log in; make somebody else one first");
}

/// In the transaction that has added a user.
UserTable::Added end_open_beginning(Sql& sql) {
  UserTable::Added added;
  long long users = 0;
  sql << "SELECT COUNT(*) FROM users", into(users);
  added.first = users == 1;
  if (!added.first) return added;
  std::string id;
  for_each_row((sql.prepare << "SELECT id FROM credentials WHERE user_id = ''", into(id)),
               [&] { added.ended.push_back(id); });
  sql << "DELETE FROM credentials WHERE user_id = ''";
  return added;
}

}  // namespace

UserTable::Added UserTable::add(const UserRow& row) {
  return database_.run([&](Sql& sql) {
    if (find_where(sql, "WHERE name = :name", row.name))
      throw Error(ErrorKind::conflict, "there is a user '" + row.name + "' already");
    const int enabled = row.enabled ? 1 : 0;
    sql << "INSERT INTO users (id, name, display_name, role, created_utc, password_hash, enabled) "
           "VALUES (:id, :name, :display_name, :role, :created_utc, :password_hash, :enabled)",
        use(row.id), use(row.name), use(row.display_name), use(row.role), use(row.created_utc),
        use(row.password_hash), use(enabled);
    long long kept = 0;
    sql << "SELECT COUNT(*) FROM users WHERE enabled = 1 AND role = :role", use(kept_role_), into(kept);
    if (kept == 0) throw Error(ErrorKind::conflict, "the first user must be " + kept_role_);
    return end_open_beginning(sql);
  });
}

UserRow UserTable::change(const std::string& id, const std::function<void(UserRow&)>& change) {
  return database_.run([&](Sql& sql) {
    UserRow row = known(sql, id);
    change(row);
    const int enabled = row.enabled ? 1 : 0;
    sql << "UPDATE users SET name = :name, display_name = :display_name, role = :role, "
           "password_hash = :password_hash, enabled = :enabled WHERE id = :id",
        use(row.name), use(row.display_name), use(row.role), use(row.password_hash), use(enabled), use(id);
    require_some_left(sql, kept_role_, row.name);
    return row;
  });
}

void UserTable::remove(const std::string& id) {
  database_.run([&](Sql& sql) {
    const std::string name = known(sql, id).name;
    sql << "DELETE FROM users WHERE id = :id", use(id);
    sql << "DELETE FROM kept_answers WHERE caller = :caller OR REPLACE(body, :id, '') <> body", use(id),
        use(id);
    require_some_left(sql, kept_role_, name);
  });
}

std::optional<UserRow> UserTable::find(const std::string& id) const {
  return database_.read([&](Sql& sql) { return find_where(sql, "WHERE id = :id", id); });
}

std::optional<UserRow> UserTable::find_by_name(const std::string& name) const {
  return database_.read([&](Sql& sql) { return find_where(sql, "WHERE name = :name", name); });
}

std::vector<UserRow> UserTable::list() const {
  return database_.read([](Sql& sql) {
    std::vector<UserRow> rows;
    UserRow row;
    int enabled = 0;
    for_each_row(
        (sql.prepare << columns + "ORDER BY name", into(row.id), into(row.name), into(row.display_name),
         into(row.role), into(row.created_utc), into(row.password_hash), into(enabled)),
        [&] {
          row.enabled = enabled != 0;
          rows.push_back(row);
        });
    return rows;
  });
}

bool UserTable::any() const {
  return database_.read([](Sql& sql) {
    long long count = 0;
    sql << "SELECT COUNT(*) FROM users", into(count);
    return count > 0;
  });
}

}  // namespace ream::store
