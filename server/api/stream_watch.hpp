#pragma once
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "access/credentials.hpp"
#include "net/message.hpp"
#include "net/websocket.hpp"

namespace ream::api {

/// Ends WebSockets whose credential is good no more: at once when it is revoked here, within seconds when it
/// ends or is revoked by another process. While a database cannot be asked they go on. Thread-safe.
class StreamWatch {
 public:
  /// Of the closing handshake: the credential is good no more.
  static constexpr uint16_t access_ended = 4003;

  /// `credentials` outlives the watch, which takes its on_change().
  explicit StreamWatch(access::Credentials& credentials,
                       std::chrono::milliseconds look_every = std::chrono::seconds(2));
  ~StreamWatch();
  StreamWatch(const StreamWatch&) = delete;
  StreamWatch& operator=(const StreamWatch&) = delete;

  /// `inner` as it is when nobody in particular has opened it.
  std::unique_ptr<net::WebSocketSession> watched(const net::Request& request,
                                                 std::unique_ptr<net::WebSocketSession> inner);

 private:
  struct Stream;
  class WatchedSession;
  void end(const std::vector<std::string>& credentials);
  void look();
  void look_at_all();
  std::vector<std::shared_ptr<Stream>> open_streams();

  access::Credentials& credentials_;
  const std::chrono::milliseconds look_every_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::weak_ptr<Stream>> streams_;
  bool stopped_ = false;
  std::thread thread_;
};

}  // namespace ream::api
