#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "store/database.hpp"

namespace ream::store {

/// One change of access or data, or one reading of data.
struct AuditRow {
  int64_t number = 0;  ///< later rows have greater ones
  std::string at_utc;
  std::string user_id, name, role, credential, address;  ///< who
  std::string action, object, detail;                    ///< what
  std::string nonce =
      {};                 ///< makes the seal of texts that are easily guessed a secret; empty: made anonymous
  std::string seal = {};  ///< covers nonce, name, address and detail: what may be made anonymous
  std::string chain = {};  ///< covers the chain of the row before, the seal and all else

  bool operator==(const AuditRow&) const = default;
};

/// Sets a row's nonce, seal and chain, which follows `previous`, the chain of the row before it.
using AuditLink = std::function<void(const std::string& previous, AuditRow& row)>;

/// Where the log has come to.
struct AuditHead {
  int64_t number = 0;
  std::string chain;
};

/// Grows only; texts about a person may be taken out. Thread-safe; errors are those of Database.
class AuditTable {
 public:
  AuditTable(Database& database, AuditLink link) : database_(database), link_(std::move(link)) {}

  /// The number is given here. Rows of a time before there was a chain are chained first.
  void add(const AuditRow& row);
  /// Does all that add() does and takes it back: throws what add() would.
  void try_to_add(const AuditRow& row);
  /// At most `max_rows` rows with numbers below `before`, newest first.
  std::vector<AuditRow> list(int64_t before, int max_rows) const;
  /// At most `max_rows` rows with numbers above `after`, oldest first.
  std::vector<AuditRow> list_from(int64_t after, int max_rows) const;
  /// None as long as there is no chain.
  std::optional<AuditHead> head() const;
  /// Takes name, address, detail and nonce out of rows by or about somebody: with this id as user or object,
  /// or one of these texts in the detail. Returns how many.
  int64_t make_anonymous(const std::string& user_id, const std::vector<std::string>& texts);

 private:
  void append(Sql& sql, AuditRow row) const;
  AuditHead chain_all(Sql& sql) const;

  Database& database_;
  const AuditLink link_;
};

}  // namespace ream::store
