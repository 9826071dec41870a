#pragma once
#include "device/haptic_device.hpp"

namespace ream::device {

/// From now on a crash of this process takes the force away from every watched device before it takes its
/// usual course: SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS, SIGXCPU, and an exception that
/// nobody catches. So does a process that was told to end and has not (catch_interrupts), which then says so
/// and exits with 1. Where a device allows that from a signal handler; others are left to their own
/// watchdogs.
void take_force_away_on_crash();

/// Takes the force away from every watched device, says `words` and exits with 1 at once, with nothing else
/// tidied: for a thread that stands still for good, which can be neither waited for nor left behind.
[[noreturn]] void end_process_without_force(const char* words) noexcept;

/// While it lives, its device is watched. The first 64 at once are; more go without. Handlers that a library
/// has put in the place of ours meanwhile are ours again.
class CrashWatch {
 public:
  explicit CrashWatch(HapticDevice& device) noexcept;
  ~CrashWatch();
  CrashWatch(const CrashWatch&) = delete;
  CrashWatch& operator=(const CrashWatch&) = delete;

  /// False: a crash would leave this device with its force.
  bool is_watched() const noexcept { return place_ >= 0 && handlers_hold_; }

 private:
  int place_ = -1;
  bool handlers_hold_ = false;
};

}  // namespace ream::device
