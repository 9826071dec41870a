#include "store/audit_table.hpp"

#include "store/sql.hpp"

namespace ream::store {
namespace {

const std::string audit_columns =
    "SELECT number, at_utc, user_id, name, role, credential, address, action, object, detail, nonce, seal, "
    "chain "
    "FROM audit ";

/// Those that `condition` lets pass, which has two parameters.
std::vector<AuditRow> rows_where(Sql& sql, const std::string& condition, long long number, int max_rows) {
  std::vector<AuditRow> rows;
  AuditRow row;
  long long at = 0;
  for_each_row((sql.prepare << audit_columns + condition, use(number), use(max_rows), into(at),
                into(row.at_utc), into(row.user_id), into(row.name), into(row.role), into(row.credential),
                into(row.address), into(row.action), into(row.object), into(row.detail), into(row.nonce),
                into(row.seal), into(row.chain)),
               [&] {
                 row.number = at;
                 rows.push_back(row);
               });
  return rows;
}

std::optional<AuditHead> head_in(Sql& sql) {
  long long number = 0;
  AuditHead head;
  sql << "SELECT number, chain FROM audit_head WHERE id = 1", into(number), into(head.chain);
  head.number = number;
  return sql.got_data() ? std::optional(head) : std::nullopt;
}

void keep_head(Sql& sql, const AuditHead& head) {
  const long long number = head.number;
  sql << "INSERT INTO audit_head (id, number, chain) VALUES (1, :number, :chain) "
         "ON CONFLICT (id) DO UPDATE SET number = excluded.number, chain = excluded.chain",
      use(number), use(head.chain);
}

/// Undoes a transaction in which all has gone well.
struct TakeBack {};

}  // namespace

AuditHead AuditTable::chain_all(Sql& sql) const {
  constexpr int all = 1 << 30;
  AuditHead head;
  for (AuditRow& row : rows_where(sql, "WHERE number > :after ORDER BY number LIMIT :most", 0, all)) {
    link_(head.chain, row);
    const long long number = row.number;
    sql << "UPDATE audit SET nonce = :nonce, seal = :seal, chain = :chain WHERE number = :number",
        use(row.nonce), use(row.seal), use(row.chain), use(number);
    head = {row.number, row.chain};
  }
  keep_head(sql, head);
  return head;
}

void AuditTable::append(Sql& sql, AuditRow row) const {
  auto head = head_in(sql);
  if (!head) head = chain_all(sql);
  row.number = head->number + 1;
  link_(head->chain, row);
  const long long number = row.number;
  sql << "INSERT INTO audit (number, at_utc, user_id, name, role, credential, address, action, object, "
         "detail, "
         "nonce, seal, chain) VALUES (:number, :at_utc, :user_id, :name, :role, :credential, :address, "
         ":action, "
         ":object, :detail, :nonce, :seal, :chain)",
      use(number), use(row.at_utc), use(row.user_id), use(row.name), use(row.role), use(row.credential),
      use(row.address), use(row.action), use(row.object), use(row.detail), use(row.nonce), use(row.seal),
      use(row.chain);
  keep_head(sql, {row.number, row.chain});
}

void AuditTable::add(const AuditRow& row) {
  database_.run([&](Sql& sql) { append(sql, row); });
}

void AuditTable::try_to_add(const AuditRow& row) {
  try {
    database_.run([&](Sql& sql) {
      append(sql, row);
      throw TakeBack();
    });
  } catch (const TakeBack&) {
  }
}

std::vector<AuditRow> AuditTable::list(int64_t before, int max_rows) const {
  return database_.read([&](Sql& sql) {
    return rows_where(sql, "WHERE number < :below ORDER BY number DESC LIMIT :most", before, max_rows);
  });
}

std::vector<AuditRow> AuditTable::list_from(int64_t after, int max_rows) const {
  return database_.read([&](Sql& sql) {
    return rows_where(sql, "WHERE number > :after ORDER BY number LIMIT :most", after, max_rows);
  });
}

std::optional<AuditHead> AuditTable::head() const {
  return database_.read([](Sql& sql) { return head_in(sql); });
}

int64_t AuditTable::make_anonymous(const std::string& user_id, const std::vector<std::string>& texts) {
  return database_.run([&](Sql& sql) {
    if (!head_in(sql)) chain_all(sql);
    const std::string taken_out =
        "UPDATE audit SET name = '', address = '', detail = '', nonce = '' WHERE nonce <> '' ";
    long long before = 0, after = 0;
    sql << "SELECT COUNT(*) FROM audit WHERE nonce = ''", into(before);
    sql << taken_out + "AND (user_id = :user OR object = :object)", use(user_id), use(user_id);
    for (const std::string& text : texts)
      if (!text.empty())
        sql << taken_out + "AND (name = :name OR REPLACE(detail, :text, '') <> detail)", use(text), use(text);
    sql << "SELECT COUNT(*) FROM audit WHERE nonce = ''", into(after);
    return static_cast<int64_t>(after - before);
  });
}

}  // namespace ream::store
