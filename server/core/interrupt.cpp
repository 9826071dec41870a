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

bool has(int signal, void (*handler)(int)) {
  struct sigaction there {};
  return ::sigaction(signal, nullptr, &there) == 0 && there.sa_handler == handler;
}

/// Unless a library uses it.
void end_in_order_on(int signal) {
  if (has(signal, SIG_DFL)) keep_handler(signal, remember_signal);
}

}  // namespace

void catch_interrupts(std::chrono::seconds timeout) {
  timeout_s = static_cast<sig_atomic_t>(timeout.count());
  for (const int signal : {SIGINT, SIGTERM, SIGQUIT}) keep_handler(signal, remember_signal);
  // The others that would end the process at once, with force.
  for (const int signal : {SIGUSR1, SIGUSR2, SIGVTALRM, SIGPROF, SIGIO, SIGPWR, SIGSTKFLT})
    end_in_order_on(signal);
  for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) end_in_order_on(signal);
  keep_handler(SIGHUP, has(SIGHUP, SIG_IGN) ? SIG_IGN : remember_signal);
}

void take_failed_writes_as_errors() {
  for (const int signal : {SIGXFSZ, SIGPIPE}) keep_handler(signal, SIG_IGN);
}

bool interrupted() noexcept { return signalled != 0; }

void throw_if_interrupted() {
  if (interrupted()) throw Error(ErrorKind::io, "interrupted; nothing was written");
}

}  // namespace ream
