#pragma once
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace ream {

/// Newest-wins hand-over of a small value from one writer thread to one reader thread (triple buffer):
/// wait-free on both sides, never torn, older values are overwritten unread.
template <typename T>
class LatestSlot {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  /// Writer only.
  void store(const T& value) noexcept {
    buffers_[writing_] = value;
    const uint32_t previous = middle_.exchange(writing_ | fresh_bit, std::memory_order_acq_rel);
    writing_ = previous & index_mask;
  }

  /// Reader only. False when nothing new was stored since the last call: `value` is untouched.
  bool take(T& value) noexcept {
    if ((middle_.load(std::memory_order_relaxed) & fresh_bit) == 0) return false;
    reading_ = middle_.exchange(reading_, std::memory_order_acq_rel) & index_mask;
    value = buffers_[reading_];
    return true;
  }

 private:
  static constexpr uint32_t fresh_bit = 4, index_mask = 3;
  T buffers_[3]{};
  uint32_t writing_ = 0, reading_ = 1;
  std::atomic<uint32_t> middle_{2};
};

}  // namespace ream
