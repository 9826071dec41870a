#include "support/fake_device_client.hpp"

#include <cmath>
#include <stdexcept>

namespace ream::test {
namespace {

constexpr int binary_opcode = 2, close_opcode = 8;

std::array<double, 3> numbers(const wire::Vec3* v) {
  if (v == nullptr) return {};
  return {v->x(), v->y(), v->z()};
}

}  // namespace

double Felt::force() const { return std::hypot(force_n[0], force_n[1], force_n[2]); }

FakeDeviceClient::FakeDeviceClient(uint16_t port, const std::string& session_id, uint32_t with_revision,
                                   int receive_buffer_bytes)
    : socket_(std::make_unique<RawWebSocket>(port, "/api/v1/sessions/" + session_id + "/device",
                                             std::map<std::string, std::string>{}, receive_buffer_bytes)) {
  if (socket_->handshake().status != 101)
    throw std::runtime_error("the server does not take a device: " + socket_->handshake().body);
  send_raw(greeting_bytes(with_revision, "fake client"));
  const RawWebSocket::Message answer = socket_->receive();
  if (answer.opcode == close_opcode) {
    closed_ = answer;
    return;
  }
  const wire::DeviceMessage* message = read_device_message(as_bytes(answer.payload));
  const wire::Welcome* welcome = message ? message->body_as_Welcome() : nullptr;
  if (welcome == nullptr) throw std::runtime_error("the first answer is no Welcome");
  welcomed_ = true;
  device_ = welcome->device()->str();
  force_max_n_ = welcome->force_max_n();
}

template <typename Words>
void FakeDeviceClient::number(Words& words) {
  words.sequence = ++sequence_;
  words.echo_us = felt_.stamp_us;
}

void FakeDeviceClient::send(HandleWords words) {
  number(words);
  send_raw(handle_bytes(words));
}

void FakeDeviceClient::send(SteeringWords words) {
  number(words);
  send_raw(steering_bytes(words));
}

Felt FakeDeviceClient::say(HandleWords words) {
  send(words);
  return receive().value();
}

Felt FakeDeviceClient::say(SteeringWords words) {
  send(words);
  return receive().value();
}

std::optional<Felt> FakeDeviceClient::receive() {
  if (closed_) return std::nullopt;
  const RawWebSocket::Message answer = socket_->receive();
  if (answer.opcode == close_opcode) {
    closed_ = answer;
    return std::nullopt;
  }
  if (answer.opcode != binary_opcode) throw std::runtime_error("an answer that is not binary");
  const wire::DeviceMessage* message = read_device_message(as_bytes(answer.payload));
  const wire::Feedback* f = message ? message->body_as_Feedback() : nullptr;
  if (f == nullptr) throw std::runtime_error("an answer that is no Feedback");
  felt_.sequence = f->sequence();
  felt_.tick = f->tick();
  felt_.stamp_us = f->stamp_us();
  felt_.link = f->link();
  felt_.state = f->state();
  felt_.force_n = numbers(f->force_n());
  felt_.torque_n_mm = numbers(f->torque_n_mm());
  felt_.thrust_n = f->thrust_n();
  felt_.rtt_ms = f->rtt_ms();
  felt_.engaged = f->engaged();
  return felt_;
}

std::pair<uint16_t, std::string> FakeDeviceClient::closing() {
  while (receive()) {
  }
  return {closed_->close_code().value_or(0), closed_->payload.size() > 2 ? closed_->payload.substr(2) : ""};
}

}  // namespace ream::test
