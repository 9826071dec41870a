#pragma once
#include <chrono>
#include <memory>
#include <mutex>

#include "session/service/session_service.hpp"
#include "session/service/session_socket.hpp"

namespace ream::session {

/// One session of this server. Thread-safe but for `running`, which is set before others see the entry.
struct SessionService::Entry {
  std::unique_ptr<RunningSession> running;
  std::mutex changing;  ///< one start, pause or stop at a time
  const std::chrono::steady_clock::time_point made = std::chrono::steady_clock::now();
  /// When end_unused() first found it paused, without a break since; under `changing`.
  std::optional<std::chrono::steady_clock::time_point> paused_since;

  SessionRecord record() const { return {request(), running->status()}; }
  bool live() const { return is_live(running->status().state); }
  const std::string& id() const { return id_; }
  SessionRequest request() const {
    const std::lock_guard lock(mutex_);
    return request_;
  }
  /// Its id is that of the first time.
  void label(SessionRequest request) {
    const std::lock_guard lock(mutex_);
    if (id_.empty()) id_ = request.id;
    request_ = std::move(request);
  }

 private:
  std::string id_;
  mutable std::mutex mutex_;
  SessionRequest request_;
};

/// Close code for those who watched a session until it went on as another one.
inline constexpr uint16_t goes_on_elsewhere = 4001;

/// A viewer's or device's connection to a session, which keeps it, and says goodbye when the session goes on
/// as another one. Who comes after that may stay and look.
class SessionService::ViewerSocket final : public SessionSocket {
 public:
  ViewerSocket(std::shared_ptr<Entry> entry, std::unique_ptr<net::WebSocketSession> inner)
      : SessionSocket(entry, std::move(inner)),
        entry_(std::move(entry)),
        came_late_(!entry_->request().followed_by.empty()) {}

  std::optional<net::CloseReason> close_reason() override {
    if (auto words = SessionSocket::close_reason(); words || came_late_) return words;
    const std::string next = entry_->request().followed_by;
    if (next.empty()) return std::nullopt;
    return net::CloseReason{goes_on_elsewhere, "goes on from intact bone as session " + next};
  }

 private:
  const std::shared_ptr<Entry> entry_;
  const bool came_late_;
};

}  // namespace ream::session
