#pragma once
#include <cstddef>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "api/running_session.hpp"

namespace ream::api {

struct SessionLimits {
  size_t live = 4;   ///< created, running or paused at once
  size_t kept = 16;  ///< ended ones that can still be looked at; the oldest go first
};

/// A session as others see it.
struct SessionRecord {
  SessionRequest request;
  std::string created_utc;  ///< "2025-03-01T12:00:00Z"
  SessionStatus status;
};

/// Owns the sessions of this server. Thread-safe. Unknown ids throw Error not_found.
class SessionService {
 public:
  SessionService(SessionFactory factory, SessionLimits limits);
  ~SessionService();
  SessionService(const SessionService&) = delete;
  SessionService& operator=(const SessionService&) = delete;

  /// `wanted.id` is chosen here. Errors: unavailable when as many are live as may be; those of the factory.
  SessionRecord create(SessionRequest wanted);
  /// Newest first.
  std::vector<SessionRecord> list() const;
  SessionRecord get(const std::string& id) const;
  /// Error conflict unless created.
  SessionRecord start(const std::string& id);
  /// Error conflict when it has ended already.
  SessionRecord stop(const std::string& id);
  nlohmann::json metrics(const std::string& id) const;
  /// The session lives on as long as somebody watches it. `stride` as RunningSession::subscribe.
  std::unique_ptr<net::WebSocketSession> subscribe(const std::string& id, int stride) const;

  /// Stops every session that still runs; nothing can be created or started any more.
  void shut_down();

 private:
  struct Entry;
  std::shared_ptr<Entry> find(const std::string& id) const;
  void reserve_place();
  std::string unused_id() const;
  std::vector<std::shared_ptr<Entry>> take_surplus();

  const SessionFactory factory_;
  const SessionLimits limits_;
  mutable std::mutex mutex_;
  std::vector<std::shared_ptr<Entry>> entries_;  ///< oldest first
  size_t being_made_ = 0;
  bool closed_ = false;
};

}  // namespace ream::api
