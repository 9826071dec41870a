#pragma once
#include <memory>

#include "device/device_setup.hpp"
#include "device/vendors/servo.hpp"

namespace ream::device {

/// The driver of Force Dimension's devices (omega, delta, sigma, lambda; Novint Falcon) through the maker's
/// own library. Pose and force are exchanged once a turn; the firmware's watchdog takes the force off a
/// device that has been told nothing for watchdog_ms, so that a process that dies leaves none behind. Button
/// 1 turns the spindle, 2 is the clutch, 3 pauses. The traits' force is also told to the device where the
/// library allows it. A device whose force was switched off (button, watchdog, velocity limit) is closed
/// within a tenth of a second and opened again, so that its force rises from nothing.
std::unique_ptr<Servo> make_force_dimension_servo(const DeviceSetup& setup, const DeviceTraits& traits);

/// Whether library and device of the set-up are there: empty, or one line about what to do.
std::string force_dimension_fault(const DeviceSetup& setup);

/// Longer than a force may be old (output_too_old_ns), so that a late tick alone does not set it off.
inline constexpr double watchdog_ms = 30.0;

}  // namespace ream::device
