#include "api/session_watch.hpp"

#include "core/log.hpp"
#include "core/signal_handlers.hpp"

namespace ream::api {

SessionWatch::SessionWatch(const session::SessionService& sessions, ChangeFeed& feed,
                           std::chrono::milliseconds look_every)
    : sessions_(sessions), feed_(feed) {
  thread_ = start_thread([this, look_every] {
    std::unique_lock lock(mutex_);
    while (!leaving_changed_.wait_for(lock, look_every, [this] { return leaving_; })) {
      try {
        look();
      } catch (...) {
        log::current_exception("changes of sessions could not be told");
      }
    }
  });
}

SessionWatch::~SessionWatch() { stop(); }

void SessionWatch::stop() {
  {
    const std::lock_guard lock(mutex_);
    leaving_ = true;
  }
  leaving_changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void SessionWatch::look() {
  std::map<std::string, SessionState> now;
  for (const session::SessionRecord& record : sessions_.held()) {
    const std::string& id = record.request.id;
    const SessionState state = record.status.state;
    now[id] = state;
    const auto before = known_.find(id);
    if (before != known_.end() && before->second == state) continue;
    feed_.publish(
        {"session", id, to_text(state), std::make_shared<const session::SessionRequest>(record.request)});
  }
  known_ = std::move(now);
}

}  // namespace ream::api
