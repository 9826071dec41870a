#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "device_generated.h"

namespace ream::test {

/// What a device's client says of its handle; fields of wire::Handle.
struct HandleWords {
  uint32_t sequence = 1;
  uint64_t sent_us = 0, echo_us = 0;
  uint32_t echo_age_us = 0;
  std::array<float, 4> rotation_wxyz{1, 0, 0, 0};
  std::array<double, 3> place_mm{};
  bool spindle = true, pause = false, clutch = false, deadman = true;
  std::array<float, 3> hand_force_n{};
};

/// Fields of wire::Steering.
struct SteeringWords {
  uint32_t sequence = 1;
  uint64_t sent_us = 0, echo_us = 0;
  uint32_t echo_age_us = 0;
  std::array<float, 3> sideways_mm{}, lean{0, 0, 0};  ///< lean of no length: not sent
  float push_n = 0.0f;
  bool spindle = true, pause = false;
};

template <typename Table>
std::string device_message(flatbuffers::FlatBufferBuilder& builder, wire::DeviceBody kind,
                           flatbuffers::Offset<Table> body) {
  builder.Finish(wire::CreateDeviceMessage(builder, kind, body.Union()));
  return {reinterpret_cast<const char*>(builder.GetBufferPointer()), builder.GetSize()};
}

inline wire::Button buttons(bool spindle, bool pause, bool clutch, bool deadman) {
  unsigned pressed = 0;
  if (spindle) pressed |= static_cast<unsigned>(wire::Button::spindle);
  if (pause) pressed |= static_cast<unsigned>(wire::Button::pause);
  if (clutch) pressed |= static_cast<unsigned>(wire::Button::clutch);
  if (deadman) pressed |= static_cast<unsigned>(wire::Button::deadman);
  return static_cast<wire::Button>(pressed);
}

inline std::string greeting_bytes(uint32_t revision, const std::string& name) {
  flatbuffers::FlatBufferBuilder builder;
  const auto body = wire::CreateDeviceHello(builder, revision, builder.CreateString(name));
  return device_message(builder, wire::DeviceBody::DeviceHello, body);
}

inline std::string handle_bytes(const HandleWords& words) {
  flatbuffers::FlatBufferBuilder builder;
  const auto& r = words.rotation_wxyz;
  const auto& f = words.hand_force_n;
  const wire::Quat rotation(r[0], r[1], r[2], r[3]);
  const wire::Vec3 force(f[0], f[1], f[2]);
  const auto body = wire::CreateHandle(builder, words.sequence, words.sent_us, words.echo_us, &rotation,
                                       words.place_mm[0], words.place_mm[1], words.place_mm[2],
                                       buttons(words.spindle, words.pause, words.clutch, words.deadman),
                                       &force, words.echo_age_us);
  return device_message(builder, wire::DeviceBody::Handle, body);
}

inline std::string steering_bytes(const SteeringWords& words) {
  flatbuffers::FlatBufferBuilder builder;
  const auto& s = words.sideways_mm;
  const auto& l = words.lean;
  const wire::Vec3 sideways(s[0], s[1], s[2]), lean(l[0], l[1], l[2]);
  const bool leans = l[0] != 0.0f || l[1] != 0.0f || l[2] != 0.0f;
  const auto body = wire::CreateSteering(builder, words.sequence, words.sent_us, words.echo_us, &sideways,
                                         leans ? &lean : nullptr, words.push_n,
                                         buttons(words.spindle, words.pause, false, true), words.echo_age_us);
  return device_message(builder, wire::DeviceBody::Steering, body);
}

inline std::span<const std::byte> as_bytes(const std::string& text) {
  return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

/// The message in `bytes`, which must outlive it; null when it is none.
inline const wire::DeviceMessage* read_device_message(std::span<const std::byte> bytes) {
  flatbuffers::Verifier verifier(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  return wire::VerifyDeviceMessageBuffer(verifier) ? wire::GetDeviceMessage(bytes.data()) : nullptr;
}

}  // namespace ream::test
