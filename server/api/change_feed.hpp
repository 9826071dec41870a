#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "net/message.hpp"
#include "net/websocket.hpp"
#include "session/running_session.hpp"

namespace ream::api {

/// Something that clients may want to read again.
struct Change {
  std::string kind;    ///< session, replay, case, upload, job, user, study
  std::string id;      ///< of it
  std::string change;  ///< what has happened: created, running, changed, deleted, ...
  /// The session that it is about, of kinds session, replay and job of a session; decides who is told.
  std::shared_ptr<const session::SessionRequest> session = nullptr;
};

/// Numbers changes and tells those who listen. Keeps the newest ones, so that who comes back misses nothing.
/// Numbers grow over restarts of the server. Thread-safe.
class ChangeFeed : public std::enable_shared_from_this<ChangeFeed> {
 public:
  explicit ChangeFeed(size_t max_kept = 1000);

  void publish(const Change& change);

  /// Sends JSON texts: "hello" with the newest number, then every change that `caller` may know of. `since`:
  /// the last number that the client has seen; what it has missed comes after the hello, or, where that is
  /// not kept any more, `missed` is true there, and it has to read again what it shows. A client that is too
  /// slow gets "missed" later, too.
  std::unique_ptr<net::WebSocketSession> listen(const net::Caller& caller, std::optional<uint64_t> since);

 private:
  class Listener;
  struct Kept {
    uint64_t number = 0;
    Change change;
    net::SharedBytes message;
  };
  struct Waker {
    const void* of;
    std::function<void()> wake;
  };
  struct Next {
    net::SharedBytes message;  ///< null: nothing for now
    bool missed = false;       ///< some before it are not kept any more
  };
  /// The next after `number` that the caller may know of; `number` becomes its own.
  Next next_after(uint64_t& number, const net::Caller& caller) const;

  const size_t max_kept_;
  mutable std::mutex mutex_;
  std::deque<Kept> kept_;  ///< oldest first, without gaps
  uint64_t newest_;
  std::vector<Waker> wakers_;
};

/// Who may know of which change: of sessions who may see them, of cases everybody who reams, of users
/// operators, of everything else operators and instructors.
bool may_know(const net::Caller& caller, const Change& change);

}  // namespace ream::api
