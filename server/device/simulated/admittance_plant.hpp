#pragma once
#include <memory>

#include "device/admittance/admittance_machine.hpp"
#include "device/script/script.hpp"

namespace ream::device {

/// What a simulated machine is like beyond its limits.
struct PlantParameters {
  std::string name;
  MachineLimits limits;
  double servo_hz = 0.0;              ///< of the position control, critically damped
  int delay_ticks = 0;                ///< until it has heard a set point
  double own_stop_mm_s2 = 0.0;        ///< how hard it brakes when it stops by itself
  double sensor_noise_rms_n = 0.0;    ///< each axis
  Vec3 sensor_bias_n = Vec3::Zero();  ///< before it is zeroed
};

/// Like a HapticMaster (Van der Linde and others, EuroHaptics 2002: 1 m/s, 50 m/s^2, 250 N peak, 0.01 N; not
/// checked against the paper). Servo and delay are engineering choices.
const PlantParameters& hapticmaster_plant();
/// Like an industrial arm of the KUKA iiwa's kind, position-controlled through its fast interface, with a
/// force sensor at its flange: 250 mm/s, as collaborative operation allows; the rest engineering choices.
const PlantParameters& robot_plant();

/// A simulated machine whose handle a simulated hand holds: the script's, through the flesh of its grip. Base
/// frame: the plan's. `traits`: those of an admittance profile. Error invalid_input for a script without a
/// hand.
std::unique_ptr<AdmittanceMachine> make_admittance_plant(const PlantParameters& plant,
                                                         const DeviceTraits& traits, const Script& script,
                                                         uint64_t random_seed);

}  // namespace ream::device
