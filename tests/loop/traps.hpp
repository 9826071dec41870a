#pragma once
#include <array>
#include <cstdint>
#include <string>

namespace ream::test {

/// What a haptic loop may not do in a tick.
enum class Trap { allocate, release, lock, wake, system_call };
inline constexpr int trap_kinds = 5;
const char* to_text(Trap trap);

/// What the watched stretch of a thread did.
struct Caught {
  std::array<uint64_t, trap_kinds> ours{};     ///< by code of this program, or what it called
  std::array<uint64_t, trap_kinds> vendors{};  ///< inside an implementation of OpenCL that it called
  std::string first;                           ///< where the first of ours was, with its callers; else empty

  uint64_t of_ours() const;
  std::string words() const;
};

/// Traps malloc and its kin, POSIX locks, condition variables and semaphores (interposed in this program) and
/// every system call (a seccomp filter) of one thread. Whatever is trapped is counted and then done, so that
/// the thread goes on as it would. Only the clock may be asked and slept on: that is how a loop waits for its
/// next tick.
///
/// arm() installs the filter on the calling thread, once and for the rest of its life, and starts to count;
/// disarm() on the same thread stops. Errors: std::runtime_error when the kernel refuses filters.
class Traps {
 public:
  /// Forgets what was caught, and looks which libraries there are.
  static void prepare();
  static void arm() noexcept;
  static void disarm() noexcept;
  /// Of the last stretch between the two, on this thread or one that has ended.
  static Caught caught();
};

}  // namespace ream::test
