#include "core/interrupt.hpp"

#include <signal.h>
#include <unistd.h>

#include "core/error.hpp"
#include "core/signal_handlers.hpp"

namespace ream {
namespace {

volatile sig_atomic_t signalled = 0, timeout_s = 0;

void remember_signal(int) {
  if (signalled == 0) ::alarm(static_cast<unsigned>(timeout_s));
  signalled = 1;
}

bool is_ignored(int signal) {
  struct sigaction there {};
  return ::sigaction(signal, nullptr, &there) == 0 && there.sa_handler == SIG_IGN;
}

}  // namespace

void catch_interrupts(std::chrono::seconds timeout) {
  timeout_s = static_cast<sig_atomic_t>(timeout.count());
  // All that would end the process at once, with force, and that nobody here has another use for.
  for (const int signal :
       {SIGINT, SIGTERM, SIGQUIT, SIGUSR1, SIGUSR2, SIGVTALRM, SIGPROF, SIGIO, SIGPWR, SIGSTKFLT})
    keep_handler(signal, remember_signal);
  for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) keep_handler(signal, remember_signal);
  keep_handler(SIGHUP, is_ignored(SIGHUP) ? SIG_IGN : remember_signal);
}

void take_failed_writes_as_errors() {
  for (const int signal : {SIGXFSZ, SIGPIPE}) keep_handler(signal, SIG_IGN);
}

bool interrupted() noexcept { return signalled != 0; }

void throw_if_interrupted() {
  if (interrupted()) throw Error(ErrorKind::io, "interrupted; nothing was written");
}

}  // namespace ream
