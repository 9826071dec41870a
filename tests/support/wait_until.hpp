#pragma once
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

namespace ream::test {

/// Waits for what must come, however slow the machine, and looks every millisecond. Throws std::runtime_error
/// with `what` when it has not come after `longest`; a test fails then.
template <typename Condition>
void wait_until(const std::string& what, Condition condition,
                std::chrono::seconds longest = std::chrono::minutes(2)) {
  const auto end = std::chrono::steady_clock::now() + longest;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) throw std::runtime_error("waited in vain for " + what);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace ream::test
