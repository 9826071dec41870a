#pragma once
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "access/access_control.hpp"
#include "core/periodic_task.hpp"
#include "net/message.hpp"
#include "net/websocket.hpp"

namespace ream::api {

/// Ends WebSockets whose credential is good no more: at once when it is revoked here, within seconds when it
/// ends or is revoked by another process. Those that were opened without one, while the server had no users,
/// end as the first user comes. While a database cannot be asked they go on. Thread-safe.
class StreamWatch {
 public:
  /// Of the closing handshake: the credential is good no more.
  static constexpr uint16_t access_ended = 4003;

  /// `access_control` outlives the watch, which takes the on_change() of its credentials.
  explicit StreamWatch(access::AccessControl& access_control,
                       std::chrono::milliseconds look_every = std::chrono::seconds(2));
  ~StreamWatch();
  StreamWatch(const StreamWatch&) = delete;
  StreamWatch& operator=(const StreamWatch&) = delete;

  /// `inner`, as long as who has opened it may have it.
  std::unique_ptr<net::WebSocketSession> watched(const net::Request& request,
                                                 std::unique_ptr<net::WebSocketSession> inner);

 private:
  struct Stream;
  class WatchedSession;
  void end(const std::vector<std::string>& credentials);
  void look();
  /// Whether the stream's caller would be let in again, with the same role.
  bool may_go_on(const Stream& stream);
  std::vector<std::shared_ptr<Stream>> open_streams();

  access::AccessControl& access_control_;
  std::mutex mutex_;
  std::vector<std::weak_ptr<Stream>> streams_;
  PeriodicTask task_;
};

}  // namespace ream::api
