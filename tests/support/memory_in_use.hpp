#pragma once
#include <fstream>
#include <string>

namespace ream::test {

/// What of this process lies in memory now (VmRSS), in KiB.
inline long memory_in_use_kib() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmRSS:")) return std::stol(line.substr(6));
  return 0;
}

/// Sanitizers keep what was freed: sizes mean nothing then.
constexpr bool memory_is_measurable() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return false;
#else
  return true;
#endif
}

}  // namespace ream::test
