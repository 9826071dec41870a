#include "store/credential_table.hpp"

#include "store/sql.hpp"

namespace ream::store {
namespace {

void remove_with_children(Sql& sql, std::vector<std::string>& ids) {
  const size_t parents = ids.size();
  for (size_t i = 0; i < parents; ++i) {
    const std::string parent = ids[i];
    std::string id;
    for_each_row((sql.prepare << "SELECT id FROM credentials WHERE parent_id = :id", use(parent), into(id)),
                 [&] { ids.push_back(id); });
  }
  for (const std::string& id : ids) sql << "DELETE FROM credentials WHERE id = :id", use(id);
}

void keep_latest_time(Sql& sql, const std::string& utc) {
  sql << "INSERT INTO credential_clock (id, latest_utc) VALUES (1, :utc) "
         "ON CONFLICT (id) DO UPDATE SET latest_utc = excluded.latest_utc",
      use(utc);
}

}  // namespace

void CredentialTable::add(const CredentialRow& row) {
  database_.run([&](Sql& sql) {
    sql << "INSERT INTO credentials (id, kind, hash, user_id, role, name, session_id, parent_id, "
           "created_utc, "
           "expires_utc, last_used_utc) VALUES (:id, :kind, :hash, :user_id, :role, :name, :session_id, "
           ":parent_id, :created_utc, :expires_utc, :last_used_utc)",
        use(row.id), use(row.kind), use(row.hash), use(row.user_id), use(row.role), use(row.name),
        use(row.session_id), use(row.parent_id), use(row.created_utc), use(row.expires_utc),
        use(row.last_used_utc);
  });
}

std::optional<KnownCredential> CredentialTable::find(const std::string& id) const {
  return database_.read([&](Sql& sql) -> std::optional<KnownCredential> {
    KnownCredential known;
    CredentialRow& row = known.credential;
    UserRow user;
    int enabled = 0;
    sql << "SELECT c.id, c.kind, c.hash, c.user_id, c.role, c.name, c.session_id, c.parent_id, "
           "c.created_utc, "
           "c.expires_utc, c.last_used_utc, COALESCE(u.id, ''), COALESCE(u.name, ''), "
           "COALESCE(u.display_name, ''), COALESCE(u.role, ''), COALESCE(u.created_utc, ''), "
           "COALESCE(u.enabled, 0) FROM credentials c LEFT JOIN users u ON u.id = c.user_id WHERE c.id = :id",
        use(id), into(row.id), into(row.kind), into(row.hash), into(row.user_id), into(row.role),
        into(row.name), into(row.session_id), into(row.parent_id), into(row.created_utc),
        into(row.expires_utc), into(row.last_used_utc), into(user.id), into(user.name),
        into(user.display_name), into(user.role), into(user.created_utc), into(enabled);
    if (!sql.got_data()) return std::nullopt;
    user.enabled = enabled != 0;
    if (!user.id.empty()) known.user = std::move(user);
    return known;
  });
}

std::vector<CredentialRow> CredentialTable::list(const std::string& kind, const std::string& user_id) const {
  return database_.read([&](Sql& sql) {
    std::vector<CredentialRow> rows;
    CredentialRow row;
    for_each_row(
        (sql.prepare << "SELECT id, kind, hash, user_id, role, name, session_id, parent_id, created_utc, "
                        "expires_utc, last_used_utc FROM credentials WHERE kind = :kind "
                        "AND (:anybody = '' OR user_id = :user_id) ORDER BY created_utc DESC, id",
         use(kind), use(user_id), use(user_id), into(row.id), into(row.kind), into(row.hash),
         into(row.user_id), into(row.role), into(row.name), into(row.session_id), into(row.parent_id),
         into(row.created_utc), into(row.expires_utc), into(row.last_used_utc)),
        [&] { rows.push_back(row); });
    return rows;
  });
}

void CredentialTable::note_use(const std::string& id, const std::string& utc) {
  database_.run([&](Sql& sql) {
    sql << "UPDATE credentials SET last_used_utc = :utc WHERE id = :id", use(utc), use(id);
  });
}

std::vector<std::string> CredentialTable::remove(const std::string& id) {
  return database_.run([&](Sql& sql) {
    std::string found;
    std::vector<std::string> ids;
    for_each_row((sql.prepare << "SELECT id FROM credentials WHERE id = :id", use(id), into(found)),
                 [&] { ids.push_back(found); });
    remove_with_children(sql, ids);
    return ids;
  });
}

std::vector<std::string> CredentialTable::remove_of_user(const std::string& user_id, const std::string& kind,
                                                         const std::string& except) {
  return database_.run([&](Sql& sql) {
    std::string found;
    std::vector<std::string> ids;
    for_each_row((sql.prepare << "SELECT id FROM credentials WHERE user_id = :user_id "
                                 "AND (:any = '' OR kind = :kind) AND id <> :except",
                  use(user_id), use(kind), use(kind), use(except), into(found)),
                 [&] { ids.push_back(found); });
    remove_with_children(sql, ids);
    return ids;
  });
}

std::string CredentialTable::latest_time() const {
  return database_.read([](Sql& sql) {
    std::string utc;
    sql << "SELECT latest_utc FROM credential_clock WHERE id = 1", into(utc);
    return sql.got_data() ? utc : std::string();
  });
}

void CredentialTable::note_latest_time(const std::string& utc) {
  database_.run([&](Sql& sql) { keep_latest_time(sql, utc); });
}

std::vector<std::string> CredentialTable::turn_back(const std::string& latest, const std::string& now,
                                                    const std::string& idle_since) {
  return database_.run([&](Sql& sql) {
    std::string found;
    std::vector<std::string> ids;
    for_each_row(
        (sql.prepare << "SELECT id FROM credentials WHERE expires_utc <= :latest OR created_utc > :now "
                        "OR (kind = 'cookie' AND last_used_utc < :idle)",
         use(latest), use(now), use(idle_since), into(found)),
        [&] { ids.push_back(found); });
    remove_with_children(sql, ids);
    sql << "UPDATE credentials SET last_used_utc = :at WHERE last_used_utc > :now", use(now), use(now);
    keep_latest_time(sql, now);
    return ids;
  });
}

void CredentialTable::remove_expired(const std::string& before_utc) {
  database_.run(
      [&](Sql& sql) { sql << "DELETE FROM credentials WHERE expires_utc < :before", use(before_utc); });
}

}  // namespace ream::store
