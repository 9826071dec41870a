#include "core/signal_handlers.hpp"

#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <mutex>

#include "core/thread_stacks.hpp"

namespace ream {
namespace {

constexpr int signals = 65;  ///< Linux numbers them from 1 to 64
/// A handler may call a device, and the kernel puts the processor's whole state beneath it.
constexpr size_t min_stack_bytes = 65536;

std::mutex handlers_mutex;
std::array<struct sigaction, signals> kept_actions;
std::array<bool, signals> is_kept{};

/// What the kernel adds to the flags on some processors is of no interest.
bool is_in_place(int signal, const struct sigaction& wanted) noexcept {
  struct sigaction there {};
  return ::sigaction(signal, nullptr, &there) == 0 && there.sa_handler == wanted.sa_handler &&
         (there.sa_flags & wanted.sa_flags) == wanted.sa_flags && (there.sa_flags & SA_RESETHAND) == 0;
}

}  // namespace

void keep_handler(int signal, void (*handler)(int), int flags) {
  const std::lock_guard lock(handlers_mutex);
  auto& action = kept_actions.at(static_cast<size_t>(signal));
  action = {};
  action.sa_handler = handler;
  action.sa_flags = flags | SA_ONSTACK;
  is_kept.at(static_cast<size_t>(signal)) = true;
  ::sigaction(signal, &action, nullptr);
}

bool restore_handlers() noexcept {
  const std::lock_guard lock(handlers_mutex);
  bool all = true;
  for (int signal = 1; signal < signals; ++signal) {
    const auto place = static_cast<size_t>(signal);
    if (!is_kept[place] || is_in_place(signal, kept_actions[place])) continue;
    ::sigaction(signal, &kept_actions[place], nullptr);
    all &= is_in_place(signal, kept_actions[place]);
  }
  return all;
}

SignalStack::SignalStack() noexcept {
  note_stack_of_this_thread();
  const auto page = static_cast<size_t>(std::max(4096L, ::sysconf(_SC_PAGESIZE)));
  const auto wanted = std::max(min_stack_bytes, static_cast<size_t>(std::max(0L, ::sysconf(_SC_SIGSTKSZ))));
  const size_t bytes = page + (wanted + page - 1) / page * page;
  void* memory = ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK, -1, 0);
  // Without memory for it, the thread goes without: only an overflow of its own stack is worse for that.
  if (memory == MAP_FAILED) return;
  stack_t ours{}, before{};
  ours.ss_sp = static_cast<char*>(memory) + page;
  ours.ss_size = bytes - page;
  if (::mprotect(ours.ss_sp, ours.ss_size, PROT_READ | PROT_WRITE) != 0 ||
      ::sigaltstack(&ours, &before) != 0) {
    ::munmap(memory, bytes);
    return;
  }
  memory_ = memory;
  bytes_ = bytes;
  if ((before.ss_flags & SS_DISABLE) != 0) return;
  before_ = before.ss_sp;
  before_bytes_ = before.ss_size;
}

SignalStack::~SignalStack() {
  if (memory_ == nullptr) return;
  stack_t before{};
  before.ss_sp = before_;
  before.ss_size = before_bytes_;
  before.ss_flags = before_ == nullptr ? SS_DISABLE : 0;
  ::sigaltstack(&before, nullptr);
  ::munmap(memory_, bytes_);
}

}  // namespace ream
