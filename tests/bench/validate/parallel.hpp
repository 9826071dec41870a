#pragma once
#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <thread>
#include <vector>

namespace ream::bench {

/// Calls work(0) to work(count - 1), each once, on all cores; what they write must not overlap. What one of
/// them throws is thrown when all are done, of several what the lowest threw.
inline void in_parallel(size_t count, const std::function<void(size_t)>& work) {
  std::atomic<size_t> next{0};
  std::vector<std::exception_ptr> failed(count);
  const auto worker = [&] {
    for (size_t i = next++; i < count; i = next++) try {
        work(i);
      } catch (...) {
        failed[i] = std::current_exception();
      }
  };
  {
    std::vector<std::jthread> helpers;
    const size_t cores = std::max(1u, std::thread::hardware_concurrency());
    for (size_t i = 1; i < std::min(cores, count); ++i) helpers.emplace_back(worker);
    worker();
  }
  for (const std::exception_ptr& one : failed)
    if (one) std::rethrow_exception(one);
}

}  // namespace ream::bench
