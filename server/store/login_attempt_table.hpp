#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "store/database.hpp"

namespace ream::store {

struct LoginFailures {
  int failures = 0;
  int64_t last_ms = 0;  ///< since 1970
};

/// Logins that failed, counted under keys, and places where a login has succeeded. Thread-safe; errors are
/// those of Database.
class LoginAttemptTable {
 public:
  explicit LoginAttemptTable(Database& database) : database_(database) {}

  /// Keys without failures are left out.
  std::map<std::string, LoginFailures> failures(const std::vector<std::string>& keys) const;
  /// One more under each key. What is older than `forget_before_ms` counts no more, and is removed.
  void note_failure(const std::vector<std::string>& keys, int64_t now_ms, int64_t forget_before_ms);
  void forget_failures(const std::string& key);

  bool knows_place(const std::string& key, int64_t since_ms) const;
  void note_place(const std::string& key, int64_t now_ms, int64_t forget_before_ms);

 private:
  Database& database_;
};

}  // namespace ream::store
