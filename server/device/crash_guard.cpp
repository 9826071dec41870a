#include "device/crash_guard.hpp"

#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>
#include <exception>

#include "core/signal_handlers.hpp"

namespace ream::device {
namespace {

/// A handler may run at any moment in any thread, so the table is of plain atomics of a fixed number.
std::array<std::atomic<HapticDevice*>, 64> watched{};
static_assert(std::atomic<HapticDevice*>::is_always_lock_free);

constexpr std::array crashes{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS, SIGXCPU};
constexpr int max_wait_ms = 1000, look_every_ms = 10;
constexpr unsigned max_release_s = 2;

std::atomic<pid_t> crashed_thread{0};
std::terminate_handler default_terminate = nullptr;

/// Puts it back by hand: whoever else had a handler (PoCL, the compiler in it) is not asked.
void restore_default_action(int signal) noexcept {
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  ::sigaction(signal, &action, nullptr);
}

/// The process is about to end, and a device that does not return must not keep it from that.
void take_all_force_away() noexcept {
  restore_default_action(SIGALRM);
  ::alarm(max_release_s);
  for (auto& place : watched)
    if (HapticDevice* device = place.load(std::memory_order_acquire)) device->take_force_away();
}

/// The first thread that crashes takes the force away; another one meanwhile lets it, and one that crashes
/// while doing so has done what it could. Then the signal is raised once more for its usual action.
void on_crash(int signal) {
  const pid_t here = ::gettid();
  pid_t first = 0;
  if (crashed_thread.compare_exchange_strong(first, here))
    take_all_force_away();
  else if (first != here)
    for (int waited_ms = 0; waited_ms < max_wait_ms; waited_ms += look_every_ms)
      ::poll(nullptr, 0, look_every_ms);
  restore_default_action(signal);
  ::raise(signal);
}

void on_terminate() {
  take_all_force_away();
  default_terminate();
}

void on_end_timeout(int) {
  end_process_without_force(
      "it was told to end and has not; sessions that were not closed are recovered at the "
      "next start");
}

}  // namespace

void take_force_away_on_crash() {
  for (const int signal : crashes) keep_handler(signal, on_crash, SA_NODEFER);
  keep_handler(SIGALRM, on_end_timeout);
  if (const auto before = std::set_terminate(on_terminate); before != on_terminate)
    default_terminate = before;
}

void end_process_without_force(const char* words) noexcept {
  take_all_force_away();
  for (const char* part : {"ream: ", words, "; the force was taken away and the process ends\n"})
    if (::write(STDERR_FILENO, part, std::strlen(part)) < 0) break;
  ::_exit(1);
}

CrashWatch::CrashWatch(HapticDevice& device) noexcept : handlers_hold_(restore_handlers()) {
  for (size_t i = 0; i < watched.size() && place_ < 0; ++i) {
    HapticDevice* nobody = nullptr;
    if (watched[i].compare_exchange_strong(nobody, &device)) place_ = static_cast<int>(i);
  }
}

CrashWatch::~CrashWatch() {
  if (place_ >= 0) watched[static_cast<size_t>(place_)].store(nullptr, std::memory_order_release);
}

}  // namespace ream::device
