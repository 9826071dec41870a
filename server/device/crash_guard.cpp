#include "device/crash_guard.hpp"

#include <signal.h>

#include <array>
#include <atomic>

namespace ream::device {
namespace {

/// A handler may run at any moment in any thread, so the table is of plain atomics of a fixed number.
std::array<std::atomic<HapticDevice*>, 64> watched{};
static_assert(std::atomic<HapticDevice*>::is_always_lock_free);

constexpr std::array crashes{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

/// A signal that was sent from outside would not come again by itself, so it is raised once more, for its
/// usual action. That is put back by hand: OpenCL's PoCL has a handler of its own for SIGFPE, which calls
/// this one.
void on_crash(int signal) {
  for (auto& place : watched)
    if (HapticDevice* device = place.load(std::memory_order_acquire)) device->take_force_away();
  struct sigaction usual {};
  usual.sa_handler = SIG_DFL;
  ::sigaction(signal, &usual, nullptr);
  ::raise(signal);
}

}  // namespace

void take_force_away_on_crash() {
  for (const int signal : crashes) {
    struct sigaction action {};
    action.sa_handler = on_crash;
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER | SA_ONSTACK);
    ::sigaction(signal, &action, nullptr);
  }
}

CrashWatch::CrashWatch(HapticDevice& device) noexcept {
  for (size_t i = 0; i < watched.size() && place_ < 0; ++i) {
    HapticDevice* nobody = nullptr;
    if (watched[i].compare_exchange_strong(nobody, &device)) place_ = static_cast<int>(i);
  }
}

CrashWatch::~CrashWatch() {
  if (place_ >= 0) watched[static_cast<size_t>(place_)].store(nullptr, std::memory_order_release);
}

}  // namespace ream::device
