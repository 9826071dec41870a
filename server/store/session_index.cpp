#include "store/session_index.hpp"

#include "store/sql.hpp"

namespace ream::store {
namespace {

void put_row(Sql& sql, const SessionRow& row) {
  const int lasting = row.lasting ? 1 : 0;
  const std::string& search = row.id;
  sql << "INSERT INTO sessions (id, case_id, script, state, created_utc, duration_s, trainee_id, trainee, "
         "study, participant, search, stamp, lasting) VALUES (:id, :case_id, :script, :state, :created_utc, "
         ":duration_s, :trainee_id, :trainee, :study, :participant, :search, :stamp, :lasting) "
         "ON CONFLICT (id) DO UPDATE SET case_id = excluded.case_id, script = excluded.script, "
         "state = excluded.state, created_utc = excluded.created_utc, duration_s = excluded.duration_s, "
         "trainee_id = excluded.trainee_id, trainee = excluded.trainee, study = excluded.study, "
         "participant = excluded.participant, search = excluded.search, stamp = excluded.stamp, "
         "lasting = excluded.lasting",
      use(row.id), use(row.case_id), use(row.script), use(row.state), use(row.created_utc),
      use(row.duration_s), use(row.trainee_id), use(row.trainee), use(row.study), use(row.participant),
      use(search), use(row.stamp), use(lasting);
  sql << "INSERT INTO session_records (id, record) VALUES (:id, :record) "
         "ON CONFLICT (id) DO UPDATE SET record = excluded.record",
      use(row.id), use(row.record);
}

}  // namespace

void SessionIndex::put(const std::vector<SessionRow>& rows) {
  database_.run([&](Sql& sql) {
    for (const SessionRow& row : rows) put_row(sql, row);
  });
}

void SessionIndex::remove(const std::vector<std::string>& ids) {
  database_.run([&](Sql& sql) {
    for (const std::string& id : ids) sql << "DELETE FROM sessions WHERE id = :id", use(id);
  });
}

std::optional<SessionRow> SessionIndex::get(const std::string& id) const {
  return database_.read([&](Sql& sql) -> std::optional<SessionRow> {
    SessionRow row;
    int lasting = 0;
    sql << "SELECT s.id, case_id, script, state, created_utc, duration_s, trainee_id, trainee, study, "
           "participant, stamp, lasting, record FROM sessions s JOIN session_records r ON r.id = s.id "
           "WHERE s.id = :id",
        use(id), into(row.id), into(row.case_id), into(row.script), into(row.state), into(row.created_utc),
        into(row.duration_s), into(row.trainee_id), into(row.trainee), into(row.study), into(row.participant),
        into(row.stamp), into(lasting), into(row.record);
    if (!sql.got_data()) return std::nullopt;
    row.lasting = lasting != 0;
    return row;
  });
}

std::map<std::string, int64_t> SessionIndex::stamps() const {
  return database_.read([](Sql& sql) {
    std::map<std::string, int64_t> found;
    std::string id;
    long long stamp = 0;
    soci::statement rows = (sql.prepare << "SELECT id, stamp FROM sessions", into(id), into(stamp));
    rows.execute();
    while (rows.fetch()) found[id] = stamp;
    return found;
  });
}

}  // namespace ream::store
