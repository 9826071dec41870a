#pragma once
#include <cstdint>
#include <mutex>
#include <set>
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

/// What is wrong with an audit log, row by row; none: nothing.
struct AuditCheck {
  std::vector<std::string> faults;  ///< for people, each naming its row
  int64_t rows = 0, anonymous = 0;
  store::AuditHead head;
};

/// What has been changed of access and data, what was read of patients and trainees, and by whom. Rows are
/// never deleted. Each covers the one before it, so that a row that was changed, taken out or put in between
/// is found by check(). Whoever can write to the database can make the whole chain anew; a head that was
/// written down elsewhere shows that, too. Thread-safe. Errors of the database: what could not be kept must
/// not be done.
class AuditLog {
 public:
  AuditLog(store::Database& database, WallClock now);

  /// `action` is a word such as "user.add", `object` the id of what was changed, `detail` a few words for
  /// people. None of them ever holds a secret, or what somebody typed in vain.
  void note(const Actor& actor, const std::string& action, const std::string& object,
            const std::string& detail);
  /// The same once for each login (without one: each address), action and object, as pages read piece by
  /// piece.
  void note_reading(const Actor& actor, const std::string& action, const std::string& object);
  /// Before something is done that is noted when it is done: throws if a row cannot be written now.
  void require_writable();

  /// At most `max_rows` rows with numbers below `before`, newest first.
  std::vector<store::AuditRow> list(int64_t before, int max_rows) const {
    return table_.list(before, max_rows);
  }
  /// At most `max_rows` rows with numbers above `after`, oldest first.
  std::vector<store::AuditRow> list_from(int64_t after, int max_rows) const {
    return table_.list_from(after, max_rows);
  }
  /// Reads all of it. `expected`: a head that was written down before, or none with number 0.
  AuditCheck check(const store::AuditHead& expected = {}) const;
  /// Rows by and about a user lose name, address and detail; ids stay, which stand for nobody then. The chain
  /// still holds, for it covers a seal of these texts. Returns how many rows.
  int64_t forget(const std::string& user_id, const std::vector<std::string>& names);

 private:
  void write(const Actor& actor, const std::string& action, const std::string& object,
             const std::string& detail, bool take_back);

  store::AuditTable table_;
  const WallClock now_;
  std::mutex mutex_;
  std::set<std::string> readings_;  ///< that were noted
};

}  // namespace ream::access
