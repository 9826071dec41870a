#pragma once
#include <cfenv>

namespace ream::plugin {

/// Puts the thread's rounding and handling of small numbers back at its end: a library that was linked with
/// -ffast-math changes them where it is loaded, and threads that are started later would have them, too.
class FloatingPoint {
 public:
  FloatingPoint() { std::fegetenv(&kept_); }
  ~FloatingPoint() { std::fesetenv(&kept_); }
  FloatingPoint(const FloatingPoint&) = delete;
  FloatingPoint& operator=(const FloatingPoint&) = delete;

 private:
  std::fenv_t kept_;
};

}  // namespace ream::plugin
