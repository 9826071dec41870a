#include "device/network/device_messages.hpp"

#include <cmath>
#include <optional>

#include "device_generated.h"

namespace ream::device {
namespace {

using flatbuffers::FlatBufferBuilder;

constexpr double max_distance_mm = 2000.0, max_force_n = 1000.0;
constexpr double unit_within = 1.0e-3;

bool within(double value, double limit) { return std::isfinite(value) && std::abs(value) <= limit; }

bool within(const std::array<double, 3>& v, double limit) {
  return within(v[0], limit) && within(v[1], limit) && within(v[2], limit);
}

std::array<double, 3> numbers(const wire::Vec3* v) {
  if (v == nullptr) return {0, 0, 0};
  return {v->x(), v->y(), v->z()};
}

/// Empty unless it is a rotation.
std::optional<std::array<double, 4>> unit(const wire::Quat& q) {
  const std::array<double, 4> raw{q.w(), q.x(), q.y(), q.z()};
  const double length = std::sqrt(raw[0] * raw[0] + raw[1] * raw[1] + raw[2] * raw[2] + raw[3] * raw[3]);
  if (!(std::abs(length - 1.0) <= unit_within)) return std::nullopt;
  return std::array{raw[0] / length, raw[1] / length, raw[2] / length, raw[3] / length};
}

/// What Handle and Steering share; false for buttons that do not exist.
template <typename Table>
bool take_common(const Table& table, InputMessage& message) {
  const auto pressed = static_cast<uint8_t>(table.buttons());
  const auto has = [&](wire::Button button) { return (pressed & static_cast<uint8_t>(button)) != 0; };
  message.sequence = table.sequence();
  message.echo_us = table.echo_us();
  message.echo_age_us = table.echo_age_us();
  message.input.spindle_on = has(wire::Button::spindle);
  message.input.paused = has(wire::Button::pause);
  message.input.drive = {static_cast<uint8_t>(255 - table.trigger_slack()), has(wire::Button::reverse),
                         has(wire::Button::irrigate)};
  message.input.clutch = has(wire::Button::clutch);
  message.input.deadman = has(wire::Button::deadman);
  return (pressed & ~static_cast<unsigned>(wire::Button::ANY)) == 0;
}

ClientMessage read(const wire::Handle& handle) {
  InputMessage message;
  if (!take_common(handle, message)) return Refusal{"Handle presses a button that does not exist"};
  if (handle.rotation() == nullptr) return Refusal{"Handle has no rotation"};
  const auto rotation = unit(*handle.rotation());
  if (!rotation) return Refusal{"the rotation of Handle is not a unit quaternion"};
  message.input.rotation_wxyz = *rotation;
  message.input.place_mm = {handle.x_mm(), handle.y_mm(), handle.z_mm()};
  if (!within(message.input.place_mm, max_distance_mm))
    return Refusal{"the place of Handle is not finite or beyond 2 m"};
  message.input.hand_force_n = numbers(handle.hand_force_n());
  if (!within(message.input.hand_force_n, max_force_n))
    return Refusal{"the hand's force in Handle is not finite or beyond 1000 N"};
  return message;
}

ClientMessage read(const wire::Steering& steering) {
  InputMessage message;
  message.input.steering = true;
  if (!take_common(steering, message)) return Refusal{"Steering presses a button that does not exist"};
  message.input.sideways_mm = numbers(steering.sideways_mm());
  if (!within(message.input.sideways_mm, max_distance_mm))
    return Refusal{"sideways_mm of Steering is not finite or beyond 2 m"};
  message.input.lean = numbers(steering.lean());
  if (!within(message.input.lean, 1.0e6)) return Refusal{"lean of Steering is not finite"};
  const auto& lean = message.input.lean;
  if (steering.lean() != nullptr && !(std::hypot(lean[0], lean[1], lean[2]) > 1.0e-6))
    return Refusal{"lean of Steering has no length"};
  message.input.push_n = steering.push_n();
  if (!within(message.input.push_n, max_force_n))
    return Refusal{"push_n of Steering is not finite or beyond 1000 N"};
  return message;
}

template <typename Table>
net::SharedBytes finished(FlatBufferBuilder& builder, wire::DeviceBody kind,
                          flatbuffers::Offset<Table> body) {
  builder.Finish(wire::CreateDeviceMessage(builder, kind, body.Union()));
  const auto* begin = reinterpret_cast<const std::byte*>(builder.GetBufferPointer());
  return std::make_shared<const net::Bytes>(begin, begin + builder.GetSize());
}

wire::Vec3 to_wire(const std::array<double, 3>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

template <typename Ours, typename Wire>
constexpr bool same(Ours ours, Wire theirs) {
  return static_cast<int>(ours) == static_cast<int>(theirs);
}
static_assert(same(LinkState::fresh, wire::LinkState::fresh) && same(LinkState::lost, wire::LinkState::lost));
static_assert(same(SessionState::created, wire::SessionState::created) &&
              same(SessionState::interrupted, wire::SessionState::interrupted));

}  // namespace

ClientMessage read_client_message(std::span<const std::byte> bytes) {
  flatbuffers::Verifier verifier(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  if (!wire::VerifyDeviceMessageBuffer(verifier)) return Refusal{"it is no DeviceMessage"};
  const wire::DeviceMessage* message = wire::GetDeviceMessage(bytes.data());
  if (const auto* hello = message->body_as_DeviceHello())
    return DeviceGreeting{hello->protocol_revision(),
                          hello->name() ? hello->name()->str().substr(0, 100) : ""};
  if (const auto* handle = message->body_as_Handle()) return read(*handle);
  if (const auto* steering = message->body_as_Steering()) return read(*steering);
  return Refusal{"a device's client sends DeviceHello, Handle and Steering only"};
}

net::SharedBytes welcome_message(const DeviceWelcome& welcome) {
  FlatBufferBuilder builder;
  const auto body = wire::CreateWelcome(
      builder, device_protocol_revision, builder.CreateString(welcome.session_id),
      builder.CreateString(welcome.device), static_cast<float>(welcome.force_max_n),
      static_cast<float>(welcome.stale.fade_ms), static_cast<float>(welcome.stale.lost_ms));
  return finished(builder, wire::DeviceBody::Welcome, body);
}

net::SharedBytes feedback_message(const DeviceFeedback& feedback) {
  FlatBufferBuilder builder(256);
  const RemoteOutput& output = feedback.output;
  const wire::Vec3 force = to_wire(output.force_n), torque = to_wire(output.torque_n_mm);
  const auto body = wire::CreateFeedback(
      builder, feedback.sequence, feedback.stamp_us, output.tick, static_cast<wire::LinkState>(output.link),
      static_cast<wire::SessionState>(feedback.state), &force, &torque, static_cast<float>(output.thrust_n),
      static_cast<float>(output.vibration_g), output.engaged, static_cast<float>(feedback.rtt_ms));
  return finished(builder, wire::DeviceBody::Feedback, body);
}

}  // namespace ream::device
