#pragma once
#include <future>
#include <thread>
#include <utility>

namespace ream {

/// From now on `handler` answers `signal`, on the alternate stack of its thread where it has one
/// (SignalStack). `flags`: more of sigaction's. Libraries may put handlers of their own in its place (the
/// compiler in PoCL does so for crashes and for the signals to end, when it builds its first kernel);
/// restore_handlers() takes it back.
void keep_handler(int signal, void (*handler)(int), int flags = 0);

/// Puts back every kept handler that somebody else has replaced, and reads each to be sure. False when the
/// system has one that is not ours all the same. Costs a system call for each; not for a tick or a handler.
bool restore_handlers() noexcept;

/// While it lives, signal handlers run on a stack of their own when they interrupt this thread, so that one
/// of a crash can run where the thread's own stack has overflowed. A page that nobody may touch lies beneath
/// it. Threads that libraries start (PoCL's workers, a maker's driver) have none.
class SignalStack {
 public:
  SignalStack() noexcept;
  ~SignalStack();
  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;

 private:
  void* memory_ = nullptr;
  void* before_ = nullptr;  ///< the stack that the thread had
  size_t before_bytes_ = 0, bytes_ = 0;
};

/// How every thread of ours is started: std::thread with a SignalStack. What `work` lets escape ends the
/// process, without force.
template <typename Work>
std::thread start_thread(Work work) {
  return std::thread([work = std::move(work)]() mutable {
    const SignalStack stack;
    work();
  });
}
/// As std::async on a thread of its own: what `work` returns or throws is the future's.
template <typename Work>
auto start_task(Work work) {
  return std::async(std::launch::async, [work = std::move(work)]() mutable {
    const SignalStack stack;
    return work();
  });
}

}  // namespace ream
