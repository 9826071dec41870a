#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/utc.hpp"
#include "store/audit_table.hpp"

namespace ream::access {

/// Who did something, as far as it is known.
struct Actor {
  std::string user_id, name, role, credential;  ///< as of net::Caller
  std::string address;                          ///< empty: at the command line
};

/// What has been changed of access and data, and by whom. Thread-safe.
class AuditLog {
 public:
  AuditLog(store::Database& database, WallClock now) : table_(database), now_(std::move(now)) {}

  /// `action` is a word such as "user.add", `object` the id of what was changed, `detail` a few words for
  /// people. None of them ever holds a secret, or what somebody typed in vain. What cannot be kept is said in
  /// the server's log.
  void note(const Actor& actor, const std::string& action, const std::string& object,
            const std::string& detail) noexcept;

  /// At most `most` rows with numbers below `before`, newest first. Errors of the database.
  std::vector<store::AuditRow> list(int64_t before, int most) const { return table_.list(before, most); }

 private:
  store::AuditTable table_;
  const WallClock now_;
};

}  // namespace ream::access
