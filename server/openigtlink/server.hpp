#pragma once
#include <atomic>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "openigtlink/active_session.hpp"
#include "openigtlink/bone_picture.hpp"
#include "openigtlink/client_connection.hpp"
#include "openigtlink/telemetry_messages.hpp"
#include "stream/mailbox.hpp"

namespace ream::openigtlink {

struct ServerOptions {
  std::string host = "127.0.0.1";
  uint16_t port = 18944;  ///< 0: any free one
  size_t max_clients = 8;
  int64_t bone_interval_ns = 500'000'000;  ///< at least, between two surfaces
};

/// Shows the active session to OpenIGTLink clients such as 3D Slicer, in RAS: poses and forces as
/// often as the stream has them, the bone's surface when a client comes and after changes. It follows the
/// session as a viewer does, on one thread of its own, and only while there are clients; nothing that happens
/// here reaches the session. The protocol has neither logins nor encryption: who reaches the port watches.
class Server {
 public:
  /// Listens from here on. Errors: those of ListeningSocket.
  Server(ServerOptions options, std::shared_ptr<const ActiveSession> active_session);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  uint16_t port() const { return socket_.port(); }

 private:
  void run() noexcept;
  void poll_once();
  void wait_for_events() const;
  void accept_clients();
  void follow_active_session();
  void unsubscribe();
  void take(int64_t now_ns);
  void put_bone(int64_t now_ns);

  const ServerOptions options_;
  const std::shared_ptr<const ActiveSession> active_session_;
  const ListeningSocket socket_;
  FileDescriptor wake_;
  std::atomic<bool> stopping_{false};

  // Of the thread.
  std::vector<ClientConnection> clients_;
  MessageCache cache_;
  std::shared_ptr<const SessionView> session_;  ///< whose surface the picture is; null: nobody's
  std::shared_ptr<stream::Mailbox> mailbox_;    ///< null: nobody watches
  std::optional<BonePicture> picture_;
  bool bone_changed_ = false;
  int64_t bone_due_ns_ = 0;
  LastSent sent_;
  std::thread thread_;
};

}  // namespace ream::openigtlink
