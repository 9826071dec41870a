#pragma once
#include "access/audit_log.hpp"
#include "access/credentials.hpp"
#include "access/login_backoff.hpp"
#include "access/password_hasher.hpp"
#include "access/users.hpp"
#include "core/utc.hpp"

namespace ream::access {

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
