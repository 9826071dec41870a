#pragma once
#include <chrono>
#include <string>

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

/// Makes guessing slow. Failures count for the name at that address, for the name, and for the address; the
/// last two do not bind people at places where they have logged in within 90 days, so that one who guesses
/// keeps nobody else out. Names that do not exist are treated like others. Thread-safe; errors of the
/// database, and TooManyAttempts.
class LoginBackoff {
 public:
  LoginBackoff(store::Database& database, WallClock now) : attempts_(database), now_(std::move(now)) {}

  /// Error TooManyAttempts while one has to wait.
  void require_allowed(const std::string& name, const std::string& address);
  void note_failure(const std::string& name, const std::string& address);
  void note_success(const std::string& name, const std::string& address);
  /// The name's failures everywhere, after an operator has given a new password.
  void forget(const std::string& name);

 private:
  int64_t now_ms() const;

  store::LoginAttemptTable attempts_;
  const WallClock now_;
};

/// What counts as one place: the address of IPv4, the first 64 bits of IPv6.
std::string place_of(const std::string& address);

}  // namespace ream::access
