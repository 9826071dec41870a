#pragma once
#include <chrono>
#include <map>

#include "api/change_feed.hpp"
#include "core/periodic_task.hpp"
#include "session/service/session_service.hpp"

namespace ream::api {

/// Looks at the sessions of this server several times a second and tells when one has come into another
/// state, so that neither a haptic loop nor its follower ever waits for those who want to know.
class SessionWatch {
 public:
  /// Both outlive it.
  SessionWatch(const session::SessionService& sessions, ChangeFeed& feed,
               std::chrono::milliseconds look_every = std::chrono::milliseconds(100));

  void stop() { task_.stop(); }

 private:
  void look();

  const session::SessionService& sessions_;
  ChangeFeed& feed_;
  std::map<std::string, SessionState> known_;
  PeriodicTask task_;
};

}  // namespace ream::api
