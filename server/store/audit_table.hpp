#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "store/database.hpp"

namespace ream::store {

/// One change of access or data.
struct AuditRow {
  int64_t number = 0;  ///< given by the database; later rows have greater ones
  std::string at_utc;
  std::string user_id, name, role, credential, address;  ///< who
  std::string action, object, detail;                    ///< what

  bool operator==(const AuditRow&) const = default;
};

/// Grows only. Thread-safe; errors are those of Database.
class AuditTable {
 public:
  explicit AuditTable(Database& database) : database_(database) {}

  void add(const AuditRow& row);
  /// At most `max_rows` rows with numbers below `before`, newest first.
  std::vector<AuditRow> list(int64_t before, int max_rows) const;

 private:
  Database& database_;
};

}  // namespace ream::store
