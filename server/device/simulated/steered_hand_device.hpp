#pragma once
#include <memory>

#include "core/clock.hpp"
#include "device/haptic_device.hpp"
#include "device/network/remote_link.hpp"

namespace ream::device {

/// How far a person with a mouse can go; what they command beyond is cut to this.
struct SteeringLimits {
  static constexpr double max_push_n = 120.0, min_push_n = -30.0;  ///< simulated
  static constexpr double max_sideways_mm = 60.0;                  ///< from the planned entry
  static constexpr double max_lean_rad = 0.5235987755982988;       ///< 30 degrees
};

/// A simulated hand that does what a person with a mouse, a touch screen, keys or a gamepad commands: 60
/// commands a second become a hand's smooth motion. It begins 10 mm before the planned entry. When the
/// commands stop coming its push falls to nothing as the force on it fades; when they stay away it rests.
/// `profile`: what the hand feels through, name in device/profiles.hpp. `force_scale`: simulated N per hand
/// N. Error invalid_input for unknown profiles and admittance devices.
std::unique_ptr<HapticDevice> make_steered_hand_device(const std::string& profile,
                                                       const Pose& world_from_plan, double force_scale,
                                                       std::shared_ptr<RemoteLink> link,
                                                       int64_t (*now_ns)() = steady_ns);

}  // namespace ream::device
