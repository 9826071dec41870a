#include "api/session_watch.hpp"

namespace ream::api {

SessionWatch::SessionWatch(const session::SessionService& sessions, ChangeFeed& feed,
                           std::chrono::milliseconds look_every)
    : sessions_(sessions),
      feed_(feed),
      task_(
          "changes of sessions could not be announced",
          [this, look_every] {
            look();
            return look_every;
          },
          look_every) {
  task_.start(look_every, false);
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
