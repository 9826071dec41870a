#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "access/credentials.hpp"
#include "access/login_backoff.hpp"
#include "access/password_hasher.hpp"
#include "access/users.hpp"
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

  /// At most `max_rows` rows with numbers below `before`, newest first. Errors of the database.
  std::vector<store::AuditRow> list(int64_t before, int max_rows) const {
    return table_.list(before, max_rows);
  }

 private:
  store::AuditTable table_;
  const WallClock now_;
};

struct AccessOptions {
  WallClock now = machine_clock();
  Lifetimes lifetimes;
  HashCost cost;
  size_t max_hashing = 2;  ///< see PasswordHasher
};

/// All that decides who is let in, over one database, which must outlive it.
class AccessControl {
 public:
  explicit AccessControl(store::Database& database, const AccessOptions& options = {})
      : credentials(database, options.now, options.lifetimes),
        audit(database, options.now),
        hasher_(options.max_hashing, options.cost),
        backoff_(database, options.now),
        users(database, hasher_, credentials, backoff_, options.now) {}

  Credentials credentials;
  AuditLog audit;

 private:
  PasswordHasher hasher_;
  LoginBackoff backoff_;

 public:
  Users users;
};

}  // namespace ream::access
