#pragma once
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "access/secret.hpp"

namespace ream::access {

/// What one hash takes. The usual is libsodium's "interactive": 64 MiB, about 50 ms.
struct HashCost {
  unsigned long long operations = 2;
  size_t memory_bytes = size_t{64} << 20;
};

/// Hashes passwords with argon2id, one at a time on a thread of its own. Thread-safe; a caller waits for its
/// turn.
class PasswordHasher {
 public:
  struct Verdict {
    bool right = false;
    bool outdated = false;  ///< right, but hashed at another cost: hash it anew
  };

  /// `max_pending`: calls that wait or run at once; fewer than the threads that serve requests, so that a
  /// crowd at the login leaves some for everybody else.
  explicit PasswordHasher(size_t max_pending = 2, HashCost cost = {});
  ~PasswordHasher();
  PasswordHasher(const PasswordHasher&) = delete;
  PasswordHasher& operator=(const PasswordHasher&) = delete;

  /// Text for the database, salt and cost included. Errors: TooManyAttempts; unavailable without memory.
  std::string hash(const Secret& password);
  /// An empty `hash` (nobody of that name) is wrong and takes as long as any. Error TooManyAttempts.
  Verdict verify(const Secret& password, const std::string& hash);

 private:
  void work();
  void run_on_thread(const std::function<void()>& task);
  std::string hashed(const Secret& password) const;

  const size_t max_pending_;
  const HashCost cost_;
  std::string dummy_hash_;  ///< of the thread alone: what unknown users are checked against
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  size_t pending_ = 0;
  bool stopped_ = false;
  std::thread thread_;
};

inline constexpr size_t min_password_length = 10;  ///< characters
inline constexpr size_t max_password_bytes = 1000;

/// Error invalid_input, without a word of the password, unless it is UTF-8 of the right length and none of
/// those that are tried first: repetitions, rows of keys, one or two common words with figures
/// (common_words.txt), little more than the user's `name`.
void require_good_password(const Secret& password, const std::string& name = {});

}  // namespace ream::access
