#include "net/rate_limiter.hpp"

#include <algorithm>

namespace ream::net {
namespace {

constexpr auto sweep_again_after = std::chrono::seconds(1);

}  // namespace

double TokenBucket::tokens_at(Clock::time_point now) const {
  const double passed_s = std::chrono::duration<double>(now - filled_).count();
  return std::min(rate_.burst, tokens_ + std::max(0.0, passed_s) * rate_.per_s);
}

double TokenBucket::take(double cost, Clock::time_point now) {
  tokens_ = tokens_at(now);
  filled_ = std::max(filled_, now);
  if (tokens_ < cost) return (cost - tokens_) / rate_.per_s;
  tokens_ -= cost;
  return 0.0;
}

bool TokenBucket::full(Clock::time_point now) const { return tokens_at(now) >= rate_.burst; }

RateLimiter::RateLimiter(Rate rate, size_t max_keys)
    : rate_(rate), max_keys_(max_keys), overflow_(rate, Clock::now()) {}

double RateLimiter::take(const std::string& key, double cost, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  return bucket_of(key, now).take(cost, now);
}

size_t RateLimiter::keys() const {
  const std::lock_guard lock(mutex_);
  return buckets_.size();
}

/// With the mutex held. A full bucket tells no more than a new one: those go first.
TokenBucket& RateLimiter::bucket_of(const std::string& key, Clock::time_point now) {
  const auto found = buckets_.find(key);
  if (found != buckets_.end()) return found->second;
  if (buckets_.size() >= max_keys_ && now - swept_ >= sweep_again_after) {
    swept_ = now;
    std::erase_if(buckets_, [now](const auto& entry) { return entry.second.full(now); });
  }
  if (buckets_.size() >= max_keys_) return overflow_;
  return buckets_.emplace(key, TokenBucket(rate_, now)).first->second;
}

}  // namespace ream::net
