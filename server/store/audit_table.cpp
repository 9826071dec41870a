#include "store/audit_table.hpp"

#include "store/sql.hpp"

namespace ream::store {

void AuditTable::add(const AuditRow& row) {
  database_.run([&](Sql& sql) {
    sql << "INSERT INTO audit (at_utc, user_id, name, role, credential, address, action, object, detail) "
           "VALUES (:at_utc, :user_id, :name, :role, :credential, :address, :action, :object, :detail)",
        use(row.at_utc), use(row.user_id), use(row.name), use(row.role), use(row.credential),
        use(row.address), use(row.action), use(row.object), use(row.detail);
  });
}

std::vector<AuditRow> AuditTable::list(int64_t before, int max_rows) const {
  const long long below = before;
  return database_.read([&](Sql& sql) {
    std::vector<AuditRow> rows;
    AuditRow row;
    long long number = 0;
    for_each_row(
        (sql.prepare << "SELECT number, at_utc, user_id, name, role, credential, address, action, object, "
                        "detail FROM audit WHERE number < :below ORDER BY number DESC LIMIT :most",
         use(below), use(max_rows), into(number), into(row.at_utc), into(row.user_id), into(row.name),
         into(row.role), into(row.credential), into(row.address), into(row.action), into(row.object),
         into(row.detail)),
        [&] {
          row.number = number;
          rows.push_back(row);
        });
    return rows;
  });
}

}  // namespace ream::store
