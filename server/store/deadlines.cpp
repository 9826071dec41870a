#include "store/deadlines.hpp"

#include <sys/socket.h>

#include <utility>

namespace ream::store {

Deadlines::Deadlines() : thread_([this] { work(); }) {}

Deadlines::~Deadlines() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

Deadlines::Watch::Watch(Deadlines& deadlines, int socket, SteadyClock::time_point end)
    : deadlines_(deadlines) {
  const std::lock_guard lock(deadlines_.mutex_);
  place_ = deadlines_.sockets_.emplace(end, socket);
  if (place_ == deadlines_.sockets_.begin()) deadlines_.changed_.notify_all();
}

Deadlines::Watch::~Watch() {
  const std::lock_guard lock(deadlines_.mutex_);
  deadlines_.sockets_.erase(place_);
}

void Deadlines::work() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    const auto now = SteadyClock::now();
    auto next = sockets_.begin();
    for (; next != sockets_.end() && next->first <= now; ++next)
      if (const int socket = std::exchange(next->second, -1); socket >= 0) ::shutdown(socket, SHUT_RDWR);
    if (next == sockets_.end())
      changed_.wait(lock);
    else
      changed_.wait_until(lock, SteadyClock::time_point(next->first));
  }
}

}  // namespace ream::store
