#include "device/network/device_socket.hpp"

#include <string>

namespace ream::device {
namespace {

constexpr int64_t ns_per_us = 1000;
/// A round trip beyond this is no measurement.
constexpr int64_t max_rtt_us = 5'000'000;
/// Each new round trip counts for this share of the figure that is shown.
constexpr int64_t rtt_share = 8;

constexpr const char* replaced_text = "another client has become the device of this session";

}  // namespace

/// The server's side of one connection of a device's client.
class DeviceSocket final : public net::WebSocketSession {
 public:
  explicit DeviceSocket(std::shared_ptr<DevicePort> port) : port_(std::move(port)) {}

  void on_open(std::function<void()> wake) override { wake_ = std::move(wake); }
  std::optional<net::SharedBytes> next() override;
  std::optional<net::CloseReason> close_reason() override;
  void on_message(std::span<const std::byte> message) override;
  void on_close() noexcept override { port_->leave(number_); }

 private:
  bool greeted() const { return number_ != 0; }
  void take(const DeviceGreeting& greeting);
  void take(const InputMessage& message);
  void take(const Refusal& refusal);
  void note_round_trip(const InputMessage& message, int64_t now_ns);
  void end(DeviceClose code, std::string reason);

  const std::shared_ptr<DevicePort> port_;
  std::function<void()> wake_;
  uint64_t number_ = 0;  ///< at the port; 0: has not greeted
  std::optional<net::CloseReason> close_reason_;
  bool welcome_pending_ = false, feedback_pending_ = false;
  bool any_input_ = false;
  uint32_t sequence_ = 0;
  int64_t rtt_us_ = -1;
  int refusals_ = 0;
};

void DeviceSocket::end(DeviceClose code, std::string reason) {
  if (!close_reason_) close_reason_ = net::CloseReason{static_cast<uint16_t>(code), std::move(reason)};
}

std::optional<net::SharedBytes> DeviceSocket::next() {
  if (close_reason_ || !greeted()) return std::nullopt;
  if (welcome_pending_) {
    welcome_pending_ = false;
    return welcome_message(port_->welcome_);
  }
  if (!feedback_pending_) return std::nullopt;
  feedback_pending_ = false;
  DeviceFeedback feedback;
  feedback.sequence = sequence_;
  feedback.stamp_us = static_cast<uint64_t>(port_->now_ns_() / ns_per_us);
  feedback.state = port_->state_;
  feedback.rtt_ms = rtt_us_ < 0 ? -1.0 : 1.0e-3 * static_cast<double>(rtt_us_);
  feedback.output = port_->newest_output(number_);
  return feedback_message(feedback);
}

std::optional<net::CloseReason> DeviceSocket::close_reason() {
  if (greeted() && !port_->owned_by(number_)) end(DeviceClose::replaced, replaced_text);
  return close_reason_;
}

void DeviceSocket::on_message(std::span<const std::byte> message) {
  if (close_reason_) return;
  std::visit([this](const auto& one) { take(one); }, read_client_message(message));
  wake_();
}

void DeviceSocket::take(const DeviceGreeting& greeting) {
  if (greeted()) return take(Refusal{"DeviceHello comes once"});
  if (greeting.protocol_revision != device_protocol_revision)
    return end(DeviceClose::other_revision,
               "this server speaks revision " + std::to_string(device_protocol_revision) +
                   " of the device protocol, the client " + std::to_string(greeting.protocol_revision));
  number_ = port_->take_over(wake_);
  welcome_pending_ = true;
}

void DeviceSocket::take(const Refusal& refusal) {
  port_->link_->refused.fetch_add(1, std::memory_order_relaxed);
  if (++refusals_ >= max_refusals)
    end(DeviceClose::senseless,
        std::to_string(refusals_) + " messages were of no use; the last: " + refusal.reason);
}

void DeviceSocket::take(const InputMessage& message) {
  if (!greeted()) return take(Refusal{"the first message must be DeviceHello"});
  if (message.input.steering != (port_->kind_ == RemoteKind::steering))
    return take(Refusal{std::string("this session's device takes ") +
                        (port_->kind_ == RemoteKind::steering ? "Steering" : "Handle") + " only"});
  const uint32_t ahead = message.sequence - sequence_;
  const bool late = any_input_ && (ahead == 0 || ahead > UINT32_MAX / 2);
  if (any_input_ && !late && ahead > max_sequence_gap) return take(Refusal{"its sequence has jumped"});
  RemoteLink& link = *port_->link_;
  feedback_pending_ = true;
  if (late) {
    link.late.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  if (any_input_) link.missing.fetch_add(ahead - 1, std::memory_order_relaxed);
  RemoteInput input = message.input;
  input.arrived_ns = port_->now_ns_();
  input.connection = number_;
  if (!port_->put(number_, input)) return;
  link.received.fetch_add(1, std::memory_order_relaxed);
  any_input_ = true;
  sequence_ = message.sequence;
  note_round_trip(message, input.arrived_ns);
}

void DeviceSocket::note_round_trip(const InputMessage& message, int64_t now_ns) {
  const int64_t now_us = now_ns / ns_per_us;
  if (message.echo_us == 0 || message.echo_us > static_cast<uint64_t>(now_us)) return;
  const int64_t took_us = now_us - static_cast<int64_t>(message.echo_us) - message.echo_age_us;
  if (took_us < 0 || took_us > max_rtt_us) return;
  rtt_us_ = rtt_us_ < 0 ? took_us : rtt_us_ + (took_us - rtt_us_) / rtt_share;
  port_->link_->rtt_us.store(rtt_us_, std::memory_order_relaxed);
}

DevicePort::DevicePort(std::shared_ptr<RemoteLink> link, RemoteKind kind, DeviceWelcome welcome,
                       int64_t (*now_ns)())
    : link_(std::move(link)), kind_(kind), welcome_(std::move(welcome)), now_ns_(now_ns) {}

std::unique_ptr<net::WebSocketSession> DevicePort::connect() {
  return std::make_unique<DeviceSocket>(shared_from_this());
}

uint64_t DevicePort::take_over(std::function<void()> wake) {
  std::function<void()> wake_replaced;
  uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    number = owner_ = ++newest_;
    wake_replaced = std::exchange(wake_owner_, std::move(wake));
  }
  link_->connections.fetch_add(1, std::memory_order_relaxed);
  link_->rtt_us.store(-1, std::memory_order_relaxed);
  if (wake_replaced) wake_replaced();
  return number;
}

bool DevicePort::owned_by(uint64_t number) const {
  const std::lock_guard lock(mutex_);
  return owner_ == number;
}

void DevicePort::leave(uint64_t number) noexcept {
  const std::lock_guard lock(mutex_);
  if (owner_ != number) return;
  owner_ = 0;
  wake_owner_ = nullptr;
}

bool DevicePort::put(uint64_t number, const RemoteInput& input) {
  const std::lock_guard lock(mutex_);
  if (owner_ != number) return false;
  link_->input.store(input);
  return true;
}

RemoteOutput DevicePort::newest_output(uint64_t number) {
  const std::lock_guard lock(mutex_);
  link_->output.take(output_);
  RemoteOutput output = output_;
  const bool too_old = now_ns_() - output.written_ns > output_too_old_ns;
  if (too_old || output.connection != number || !is_live(state_) ||
      link_->force_taken_away.load(std::memory_order_acquire)) {
    output.force_n = output.torque_n_mm = {};
    output.vibration_g = 0.0;
  }
  output.link = too_old ? LinkState::lost : output.link;
  return output;
}

}  // namespace ream::device
