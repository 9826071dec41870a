#pragma once
#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>
#include <unordered_map>

namespace ream::net {

/// How many requests one may send: `per_s` in the long run, `burst` at once.
struct Rate {
  double per_s = 1.0, burst = 1.0;
};

/// A token bucket: full at first, refilled steadily, a request takes from it.
class TokenBucket {
 public:
  using Clock = std::chrono::steady_clock;

  TokenBucket(Rate rate, Clock::time_point now) : rate_(rate), tokens_(rate.burst), filled_(now) {}

  /// Takes `cost`, or nothing when there is less. Seconds until there is enough; 0 when it was taken.
  double take(double cost, Clock::time_point now);
  bool full(Clock::time_point now) const;

 private:
  double tokens_at(Clock::time_point now) const;

  Rate rate_;
  double tokens_;
  Clock::time_point filled_;
};

/// One bucket for each of many keys (addresses, callers), bounded in number: beyond that, newcomers share
/// one. Thread-safe.
class RateLimiter {
 public:
  using Clock = TokenBucket::Clock;

  explicit RateLimiter(Rate rate, size_t max_keys = 4096);

  /// Seconds after which `key` may try again; 0 when it may pass now.
  double take(const std::string& key, double cost = 1.0, Clock::time_point now = Clock::now());

  size_t keys() const;

 private:
  TokenBucket& bucket_of(const std::string& key, Clock::time_point now);

  const Rate rate_;
  const size_t max_keys_;
  mutable std::mutex mutex_;
  std::unordered_map<std::string, TokenBucket> buckets_;
  TokenBucket overflow_;
  Clock::time_point swept_;
};

}  // namespace ream::net
