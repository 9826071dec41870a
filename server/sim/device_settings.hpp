#pragma once
#include "device/haptic_device.hpp"
#include "sim/model.hpp"

namespace ream::sim {

/// Fits settings to the device that renders them: coupling of `stiffness_n_mm` (hand side; 0: the most the
/// device renders), the device's largest force and torque and their slew, its start-up ramp, how much it may
/// vibrate, and for an admittance device its virtual mass.
void fit_to_device(const device::DeviceTraits& traits, double stiffness_n_mm, Settings& settings);

}  // namespace ream::sim
