#pragma once
#include <memory>
#include <optional>
#include <string>

#include "support/device_wire.hpp"
#include "support/raw_http.hpp"

namespace ream::test {

/// What a device's client was last told.
struct Felt {
  uint32_t sequence = 0, tick = 0;
  uint64_t stamp_us = 0;
  wire::LinkState link = wire::LinkState::lost;
  wire::SessionState state = wire::SessionState::created;
  std::array<double, 3> force_n{}, torque_n_mm{};
  double thrust_n = 0.0, rtt_ms = -1.0;
  bool engaged = false;

  double force() const;
};

/// The client of a haptic device: speaks proto/device.fbs over a WebSocket of plain sockets. Failures throw
/// std::runtime_error.
class FakeDeviceClient {
 public:
  static constexpr uint32_t revision = 1;

  /// Connects and greets. `welcomed` afterwards says whether the server took it.
  FakeDeviceClient(uint16_t port, const std::string& session_id, uint32_t with_revision = revision,
                   int receive_buffer_bytes = 0);

  bool welcomed() const { return welcomed_; }
  const std::string& device() const { return device_; }
  float force_max_n() const { return force_max_n_; }

  /// Sends with the next number and the echo of the newest answer, and waits for the answer.
  Felt say(HandleWords words);
  Felt say(SteeringWords words);
  /// Sends and does not wait.
  void send(HandleWords words);
  void send(SteeringWords words);
  void send_raw(const std::string& bytes) { socket_->send_binary(bytes); }
  /// What lies below, for those who break its rules.
  RawSocket& socket() { return socket_->socket(); }
  /// The next answer; empty when the server has closed.
  std::optional<Felt> receive();
  /// Reads on until the server closes: code and words.
  std::pair<uint16_t, std::string> closing();

  /// Goes without a word, as a cable that is pulled.
  void vanish() { socket_.reset(); }
  uint32_t sequence() const { return sequence_; }
  /// The number of the next message.
  void set_sequence(uint32_t next) { sequence_ = next - 1; }
  const Felt& felt() const { return felt_; }

 private:
  template <typename Words>
  void number(Words& words);

  std::unique_ptr<RawWebSocket> socket_;
  bool welcomed_ = false;
  std::string device_;
  float force_max_n_ = 0.0f;
  uint32_t sequence_ = 0;
  Felt felt_;
  std::optional<RawWebSocket::Message> closed_;
};

}  // namespace ream::test
