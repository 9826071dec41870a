#include "store/idempotency_table.hpp"

#include "store/sql.hpp"

namespace ream::store {

namespace {

void make_room(Sql& sql, const std::string& caller) {
  const long long most = IdempotencyTable::max_answers, bytes = IdempotencyTable::max_bytes;
  sql << "DELETE FROM kept_answers WHERE caller = :owner AND key IN (SELECT key FROM (SELECT key, "
         "ROW_NUMBER() OVER (ORDER BY at_ms DESC, key) AS place, "
         "SUM(LENGTH(body)) OVER (ORDER BY at_ms DESC, key) AS bytes "
         "FROM kept_answers WHERE caller = :caller) AS newest WHERE place > :most OR bytes > :bytes)",
      use(caller), use(caller), use(most), use(bytes);
}

}  // namespace

std::optional<StoredResponse> IdempotencyTable::find(const std::string& caller,
                                                     const std::string& key) const {
  return database_.read([&](Sql& sql) -> std::optional<StoredResponse> {
    StoredResponse answer{caller, key, {}, 0, {}, {}, {}, 0};
    long long status = 0, at_ms = 0;
    sql << "SELECT request, status, content_type, location, body, at_ms FROM kept_answers "
           "WHERE caller = :caller AND key = :key",
        use(caller), use(key), into(answer.request), into(status), into(answer.content_type),
        into(answer.location), into(answer.body), into(at_ms);
    if (!sql.got_data()) return std::nullopt;
    answer.status = static_cast<int>(status);
    answer.at_ms = at_ms;
    return answer;
  });
}

void IdempotencyTable::put(const StoredResponse& answer) {
  const long long status = answer.status, at_ms = answer.at_ms;
  database_.run([&](Sql& sql) {
    sql << "INSERT INTO kept_answers (caller, key, request, status, content_type, location, body, at_ms) "
           "VALUES (:caller, :key, :request, :status, :type, :location, :body, :at) "
           "ON CONFLICT (caller, key) DO UPDATE SET request = excluded.request, status = excluded.status, "
           "content_type = excluded.content_type, location = excluded.location, body = excluded.body, "
           "at_ms = excluded.at_ms",
        use(answer.caller), use(answer.key), use(answer.request), use(status), use(answer.content_type),
        use(answer.location), use(answer.body), use(at_ms);
    make_room(sql, answer.caller);
  });
}

void IdempotencyTable::remove_before(int64_t before_ms) {
  const long long before = before_ms;
  database_.run([&](Sql& sql) { sql << "DELETE FROM kept_answers WHERE at_ms < :before", use(before); });
}

void IdempotencyTable::remove_about(const std::string& id) {
  database_.run([&](Sql& sql) {
    sql << "DELETE FROM kept_answers WHERE caller = :caller OR REPLACE(body, :in_body, '') <> body "
           "OR REPLACE(location, :in_location, '') <> location",
        use(id), use(id), use(id);
  });
}

}  // namespace ream::store
