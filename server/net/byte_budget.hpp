#pragma once
#include <atomic>
#include <cstddef>
#include <utility>

namespace ream::net {

/// Memory that many may lend from, up to a sum. Thread-safe.
class ByteBudget {
 public:
  explicit ByteBudget(size_t max_bytes) : left_(max_bytes) {}

  /// Gives its bytes back when it goes.
  class Lease {
   public:
    Lease() = default;
    Lease(Lease&& other) noexcept : budget_(std::exchange(other.budget_, nullptr)), bytes_(other.bytes_) {}
    Lease& operator=(Lease&& other) noexcept {
      std::swap(budget_, other.budget_);
      std::swap(bytes_, other.bytes_);
      return *this;
    }
    ~Lease() {
      if (budget_) budget_->left_ += bytes_;
    }
    explicit operator bool() const { return budget_ != nullptr; }

   private:
    friend class ByteBudget;
    Lease(ByteBudget& budget, size_t bytes) : budget_(&budget), bytes_(bytes) {}
    ByteBudget* budget_ = nullptr;
    size_t bytes_ = 0;
  };

  /// Empty when there is not as much left.
  Lease lend(size_t bytes) {
    size_t left = left_;
    do {
      if (left < bytes) return {};
    } while (!left_.compare_exchange_weak(left, left - bytes));
    return {*this, bytes};
  }

  size_t left() const { return left_; }

 private:
  std::atomic<size_t> left_;
};

}  // namespace ream::net
