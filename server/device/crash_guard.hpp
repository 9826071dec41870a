#pragma once
#include "device/haptic_device.hpp"

namespace ream::device {

/// From now on a crash of this process (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) takes the force away from
/// every watched device before it takes its usual course. Where a device allows that from a signal handler;
/// others are left to their own watchdogs.
void take_force_away_on_crash();

/// While it lives, its device is watched. The first 64 at once are; more go without (see is_watched).
class CrashWatch {
 public:
  explicit CrashWatch(HapticDevice& device) noexcept;
  ~CrashWatch();
  CrashWatch(const CrashWatch&) = delete;
  CrashWatch& operator=(const CrashWatch&) = delete;

  bool is_watched() const noexcept { return place_ >= 0; }

 private:
  int place_ = -1;
};

}  // namespace ream::device
