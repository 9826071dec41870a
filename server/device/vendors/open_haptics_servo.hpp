#pragma once
#include <memory>

#include "device/device_setup.hpp"
#include "device/vendors/servo.hpp"

namespace ream::device {

/// The driver of 3D Systems' Touch and Phantom devices through OpenHaptics' HDAPI. Pose and force are
/// exchanged in a callback of the maker's own servo loop, not on a thread of ours: only there frames of the
/// device may be begun without waiting, at its own millisecond and priority, and a force that grows old is
/// taken back even while every thread of ours stands still. Button 1 turns the spindle, 2 is the clutch, 3
/// pauses. Motors that grow warm get no more than their continuous force. The device's own limit counts where
/// it is lower than the traits'.
std::unique_ptr<Servo> make_open_haptics_servo(const DeviceSetup& setup, const DeviceTraits& traits);

/// Whether the library of the set-up is there: empty, or one line about what to do. The device itself can
/// only be asked for by opening it.
std::string open_haptics_fault(const DeviceSetup& setup);

/// A servo loop that has not called back for so long is dead: its force is switched off.
inline constexpr double servo_loop_timeout_ms = 40.0;

}  // namespace ream::device
