#include "core/interrupt.hpp"

#include <signal.h>

#include "core/error.hpp"

namespace ream {
namespace {

volatile sig_atomic_t signalled = 0;

void remember_signal(int) { signalled = 1; }

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = remember_signal;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

void take_file_size_limit_as_error() { ::signal(SIGXFSZ, SIG_IGN); }

bool interrupted() noexcept { return signalled != 0; }

void throw_if_interrupted() {
  if (interrupted()) throw Error(ErrorKind::io, "interrupted; nothing was written");
}

}  // namespace ream
