#pragma once
#include <atomic>
#include <cassert>
#include <cstddef>
#include <vector>

namespace ream {

/// Bounded queue between exactly one producer and one consumer thread: wait-free on both sides, and nothing
/// is allocated after construction. When it is full the push fails and the producer keeps the item.
template <typename T>
class SpscRing {
 public:
  /// `capacity` is rounded up to a power of two.
  explicit SpscRing(size_t capacity) {
    size_t size = 1;
    while (size < capacity) size *= 2;
    items_.resize(size);
  }

  size_t capacity() const { return items_.size(); }

  /// Producer only. False when full: nothing was stored.
  bool try_push(const T& item) noexcept {
    const size_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_.load(std::memory_order_acquire) == items_.size()) return false;
    items_[head & (items_.size() - 1)] = item;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  /// Consumer only. False when empty: `item` is untouched.
  bool try_pop(T& item) noexcept {
    const size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_.load(std::memory_order_acquire)) return false;
    item = items_[tail & (items_.size() - 1)];
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  /// Either side; exact only while the other side rests.
  size_t size() const noexcept {
    return head_.load(std::memory_order_acquire) - tail_.load(std::memory_order_acquire);
  }

 private:
  std::vector<T> items_;
  alignas(64) std::atomic<size_t> head_{0};
  alignas(64) std::atomic<size_t> tail_{0};
};

}  // namespace ream
