#pragma once
#include <chrono>
#include <string>

#include "access/secret.hpp"
#include "core/error.hpp"
#include "core/utc.hpp"
#include "store/login_attempt_table.hpp"

namespace ream::access {

/// Asked too often or by too many at once: try again after a while (HTTP 429).
class TooManyAttempts : public Error {
 public:
  TooManyAttempts(const std::string& message, int retry_after_s)
      : Error(ErrorKind::unavailable, message), retry_after_s_(retry_after_s) {}
  int retry_after_s() const { return retry_after_s_; }

 private:
  int retry_after_s_;
};

/// How failures make somebody wait: some are free, then the wait doubles.
struct BackoffPolicy {
  int free_failures;
  std::chrono::seconds max_wait;      ///< the first wait is one second
  std::chrono::seconds forget_after;  ///< so long after the last one failures are forgotten
};

/// After so many failures in a row.
std::chrono::seconds wait_after(int failures, const BackoffPolicy& policy);

/// Where a password was tried.
struct LoginOrigin {
  std::string address;
  /// What a browser keeps after a login, to be told from others at its address; empty: nothing.
  Secret device = {};
  bool logged_in = false;  ///< `device` is the id of what somebody is logged in with already
};

/// Makes guessing slow, and lets nobody keep somebody else out for ever.
///
/// Failures count for the name at that address, for the name, and for the address. One who guesses at the
/// same address (behind a proxy, in a hospital) or from many would lock a user out by that for as long as the
/// guessing goes on. So a browser in which the user has logged in within 90 days counts by itself alone: it
/// shows a random secret, and only its own failures make it wait. Without such a browser, an address where
/// the user has logged in is bound only by failures for that name there. Guessing gains nothing by it: who
/// has no such browser waits as before, and one that was stolen waits after four failures, too. What remains:
/// a user in a new browser, at the address of one who guesses this very name all the time, has to wait for up
/// to 15 minutes at each try; an operator's new password forgives that.
///
/// Names that do not exist are treated like others. When the clock was ahead for a while, failures from the
/// future count as of now. Thread-safe; errors of the database, and TooManyAttempts.
class LoginBackoff {
 public:
  LoginBackoff(store::Database& database, WallClock now) : attempts_(database), now_(std::move(now)) {}

  /// Error TooManyAttempts while one has to wait.
  void require_allowed(const std::string& name, const LoginOrigin& origin);
  void note_failure(const std::string& name, const LoginOrigin& origin);
  void note_success(const std::string& name, const LoginOrigin& origin);
  /// The name's failures everywhere, after an operator has given a new password.
  void forget(const std::string& name);

 private:
  int64_t now_ms() const;
  bool knows_device(const std::string& key, const LoginOrigin& origin, int64_t now) const;

  store::LoginAttemptTable attempts_;
  const WallClock now_;
};

/// What counts as one place: the address of IPv4, the first 64 bits of IPv6.
std::string place_of(const std::string& address);

}  // namespace ream::access
