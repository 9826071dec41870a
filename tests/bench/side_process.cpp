#include "bench/side_process.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.hpp"

namespace ream::bench {

SideProcess::SideProcess(const Work& work) {
  int orders[2], answers[2];
  if (::pipe(orders) != 0 || ::pipe(answers) != 0)
    throw Error(ErrorKind::unavailable, "no pipe can be made to a process beside the bench");
  child_ = ::fork();
  if (child_ < 0) throw Error(ErrorKind::unavailable, "no process can be started beside the bench");
  if (child_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::close(orders[1]);
    ::close(answers[0]);
    work(orders[0], answers[1]);
    ::_exit(0);
  }
  ::close(orders[0]);
  ::close(answers[1]);
  to_child_ = orders[1];
  from_child_ = answers[0];
}

SideProcess::~SideProcess() {
  ::close(to_child_);
  ::close(from_child_);
  ::kill(child_, SIGKILL);
  ::waitpid(child_, nullptr, 0);
}

void SideProcess::send_bytes(const void* from, size_t bytes) const {
  if (::write(to_child_, from, bytes) != static_cast<ssize_t>(bytes))
    throw Error(ErrorKind::unavailable, "the process beside the bench has ended");
}

void SideProcess::receive_bytes(void* into, size_t bytes) const {
  if (::read(from_child_, into, bytes) != static_cast<ssize_t>(bytes))
    throw Error(ErrorKind::unavailable, "the process beside the bench has ended");
}

}  // namespace ream::bench
