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
  struct Count {
    std::string key;
    int64_t restart_before_ms = 0;  ///< failures that ended earlier count no more
  };
  /// One more of each. Rows older than `forget_before_ms` are removed.
  void note_failure(const std::vector<Count>& counts, int64_t now_ms, int64_t forget_before_ms);
  /// What was noted later than now, by a clock that was ahead, counts as of now.
  void take_from_future(int64_t now_ms);
  /// Under all keys that begin so.
  void forget_failures(const std::string& beginning);

  bool knows_place(const std::string& key, int64_t since_ms) const;
  void note_place(const std::string& key, int64_t now_ms, int64_t forget_before_ms);

 private:
  Database& database_;
};

}  // namespace ream::store
