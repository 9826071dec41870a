#include "core/thread_stacks.hpp"

#include <pthread.h>

#include <algorithm>
#include <mutex>

namespace ream {
namespace {

/// Never destroyed: threads may end after the program's statics.
struct KnownStacks {
  std::mutex mutex;
  std::vector<StackRange> ranges;
};
KnownStacks& known() {
  static auto* const all = new KnownStacks;
  return *all;
}

StackRange stack_of_this_thread() {
  pthread_attr_t attributes;
  if (::pthread_getattr_np(::pthread_self(), &attributes) != 0) return {};
  void* lowest = nullptr;
  size_t bytes = 0;
  const bool found = ::pthread_attr_getstack(&attributes, &lowest, &bytes) == 0;
  ::pthread_attr_destroy(&attributes);
  if (!found) return {};
  const auto begin = reinterpret_cast<uintptr_t>(lowest);
  return {begin, begin + bytes};
}

class NotedStack {
 public:
  NotedStack() : range_(stack_of_this_thread()) {
    const std::lock_guard lock(known().mutex);
    if (range_.end > range_.begin) known().ranges.push_back(range_);
  }
  ~NotedStack() {
    const std::lock_guard lock(known().mutex);
    std::erase_if(known().ranges, [this](const StackRange& each) { return each.begin == range_.begin; });
  }
  NotedStack(const NotedStack&) = delete;
  NotedStack& operator=(const NotedStack&) = delete;

 private:
  StackRange range_;
};

}  // namespace

void note_stack_of_this_thread() noexcept {
  try {
    thread_local const NotedStack noted;
    static_cast<void>(noted);
  } catch (...) {  // it is only a thread that nobody knows of
  }
}

std::vector<StackRange> stacks_of_other_threads() {
  const StackRange own = stack_of_this_thread();
  const std::lock_guard lock(known().mutex);
  std::vector<StackRange> others = known().ranges;
  std::erase_if(others, [&](const StackRange& each) { return each.begin == own.begin; });
  std::sort(others.begin(), others.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  return others;
}

}  // namespace ream
