#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>

#include "core/clock.hpp"
#include "device/network/device_messages.hpp"
#include "net/websocket.hpp"

namespace ream::device {

/// How a device's connection ends from the server's side (WebSocket close codes).
enum class DeviceClose : uint16_t {
  other_revision = 4000,  ///< the client speaks another revision of the protocol
  replaced = 4001,        ///< another client has taken its place
  senseless = 4002,       ///< too many messages that were refused
};

/// A connection is closed when this many of its messages have been refused.
inline constexpr int max_refusals = 20;
/// A sequence that goes ahead by more than this is no sequence but a damaged message.
inline constexpr uint32_t max_sequence_gap = 100'000;

/// Which of the two kinds of input a device takes.
enum class RemoteKind { handle, steering };

/// Where the client of a session's device connects: one at a time is the device's, and one that greets takes
/// the place of the one before it. Its lock is between connections; the haptic thread knows only the link.
class DevicePort : public std::enable_shared_from_this<DevicePort> {
 public:
  /// `now_ns`: the clock of RemoteLink's times.
  DevicePort(std::shared_ptr<RemoteLink> link, RemoteKind kind, DeviceWelcome welcome,
             int64_t (*now_ns)() = steady_ns);

  /// The server's side of a new connection.
  std::unique_ptr<net::WebSocketSession> connect();

  /// What the session has come to; from any thread. Once it has ended no force goes out any more.
  void set_state(SessionState state) noexcept { state_ = state; }

 private:
  friend class DeviceSocket;

  /// The caller's number from here on; whoever was there before is woken and finds itself replaced.
  uint64_t take_over(std::function<void()> wake);
  bool owned_by(uint64_t number) const;
  void leave(uint64_t number) noexcept;
  /// False when somebody else has taken over.
  bool put(uint64_t number, const RemoteInput& input);
  /// Without force unless it is for the caller.
  RemoteOutput newest_output(uint64_t number);

  const std::shared_ptr<RemoteLink> link_;
  const RemoteKind kind_;
  const DeviceWelcome welcome_;
  int64_t (*const now_ns_)();
  std::atomic<SessionState> state_{SessionState::created};
  mutable std::mutex mutex_;  ///< guards what follows, and the sockets' ends of the link's slots
  uint64_t newest_ = 0, owner_ = 0;
  std::function<void()> wake_owner_;
  RemoteOutput output_;
};

}  // namespace ream::device
