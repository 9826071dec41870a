#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>

#include "core/session_state.hpp"
#include "device/haptic_device.hpp"
#include "device/network/remote_link.hpp"
#include "net/message.hpp"

namespace ream::device {

/// Revision of proto/device.fbs that client and server must share.
inline constexpr uint32_t device_protocol_revision = 1;

struct DeviceGreeting {
  uint32_t protocol_revision = 0;
  std::string name;  ///< who the client says it is
};

/// One Handle or Steering.
struct InputMessage {
  uint32_t sequence = 0;
  uint64_t echo_us = 0;      ///< stamp of the newest Feedback that the client had; 0: none
  uint32_t echo_age_us = 0;  ///< how long it had had it
  RemoteInput input;         ///< without its times
};

/// Why a message is of no use, in words.
struct Refusal {
  std::string reason;
};

using ClientMessage = std::variant<DeviceGreeting, InputMessage, Refusal>;

/// Reads what a client sent. Refused: what is no DeviceMessage, messages that only a server sends, numbers
/// that are not finite, rotations that are not unit quaternions within 1e-3, places beyond 2 m, forces beyond
/// 1000 N, buttons that do not exist.
ClientMessage read_client_message(std::span<const std::byte> bytes);

/// What a client is told about the session it has become the device of.
struct DeviceWelcome {
  std::string session_id, device;
  double force_max_n = 0.0;
  StaleLimits stale;
};
net::SharedBytes welcome_message(const DeviceWelcome& welcome);

struct DeviceFeedback {
  uint32_t sequence = 0;
  uint64_t stamp_us = 0;
  SessionState state = SessionState::created;
  double rtt_ms = -1.0;
  RemoteOutput output;
};
net::SharedBytes feedback_message(const DeviceFeedback& feedback);

}  // namespace ream::device
