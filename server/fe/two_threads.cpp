#include "fe/two_threads.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace ream::fe {
namespace {

class Shared {
 public:
  Shared(size_t count, const std::function<void(size_t)>& work) : count_(count), work_(work) {}

  /// `told` is called before each piece with its number.
  template <typename Told>
  void run(const Told& told) noexcept {
    try {
      while (!stopped_) {
        told(next_.load());
        const size_t i = next_++;
        if (i >= count_) return;
        work_(i);
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!first_) first_ = std::current_exception();
      stopped_ = true;
    }
  }

  void rethrow() const {
    if (first_) std::rethrow_exception(first_);
  }

 private:
  const size_t count_;
  const std::function<void(size_t)>& work_;
  std::atomic<size_t> next_{0};
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;
  std::exception_ptr first_;
};

}  // namespace

void on_two_threads(size_t count, const std::function<void(size_t)>& work, const Progress& progress,
                    std::string_view step) {
  if (!step.empty()) progress(0.0, step);
  Shared shared(count, work);
  {
    std::jthread second;
    if (count > 1) second = std::jthread([&] { shared.run([](size_t) {}); });
    shared.run([&](size_t i) {
      if (i < count) progress(static_cast<double>(i) / static_cast<double>(count), step);
    });
  }
  shared.rethrow();
}

}  // namespace ream::fe
