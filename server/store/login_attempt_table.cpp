#include "store/login_attempt_table.hpp"

#include "store/sql.hpp"

namespace ream::store {

std::map<std::string, LoginFailures> LoginAttemptTable::failures(const std::vector<std::string>& keys) const {
  return database_.read([&](Sql& sql) {
    std::map<std::string, LoginFailures> found;
    for (const std::string& key : keys) {
      long long count = 0, last_ms = 0;
      sql << "SELECT failures, last_ms FROM login_failures WHERE key = :key", use(key), into(count),
          into(last_ms);
      if (sql.got_data()) found[key] = {static_cast<int>(count), last_ms};
    }
    return found;
  });
}

void LoginAttemptTable::note_failure(const std::vector<Count>& counts, int64_t now_ms,
                                     int64_t forget_before_ms) {
  const long long now = now_ms, oldest = forget_before_ms;
  database_.run([&](Sql& sql) {
    sql << "DELETE FROM login_failures WHERE last_ms < :oldest", use(oldest);
    for (const Count& count : counts) {
      const long long restart = count.restart_before_ms;
      sql << "INSERT INTO login_failures (key, failures, last_ms) VALUES (:key, 1, :now) ON CONFLICT (key) "
             "DO UPDATE SET failures = CASE WHEN login_failures.last_ms < :restart THEN 1 "
             "ELSE login_failures.failures + 1 END, last_ms = excluded.last_ms",
          use(count.key), use(now), use(restart);
    }
  });
}

void LoginAttemptTable::take_from_future(int64_t now_ms) {
  const long long now = now_ms;
  database_.run([&](Sql& sql) {
    sql << "UPDATE login_failures SET last_ms = :at WHERE last_ms > :now", use(now), use(now);
    sql << "UPDATE login_places SET last_ms = :at WHERE last_ms > :now", use(now), use(now);
  });
}

void LoginAttemptTable::forget_failures(const std::string& beginning) {
  const auto length = static_cast<long long>(beginning.size());
  database_.run([&](Sql& sql) {
    sql << "DELETE FROM login_failures WHERE SUBSTR(key, 1, :length) = :beginning", use(length),
        use(beginning);
  });
}

bool LoginAttemptTable::knows_place(const std::string& key, int64_t since_ms) const {
  const long long since = since_ms;
  return database_.read([&](Sql& sql) {
    long long last_ms = 0;
    sql << "SELECT last_ms FROM login_places WHERE key = :key AND last_ms >= :since", use(key), use(since),
        into(last_ms);
    return sql.got_data();
  });
}

void LoginAttemptTable::note_place(const std::string& key, int64_t now_ms, int64_t forget_before_ms) {
  const long long now = now_ms, oldest = forget_before_ms;
  database_.run([&](Sql& sql) {
    sql << "DELETE FROM login_places WHERE last_ms < :oldest", use(oldest);
    sql << "INSERT INTO login_places (key, last_ms) VALUES (:key, :now) ON CONFLICT (key) "
           "DO UPDATE SET last_ms = excluded.last_ms",
        use(key), use(now);
  });
}

}  // namespace ream::store
