#include "sim/device_settings.hpp"

#include <algorithm>

namespace ream::sim {
namespace {

/// A coupling turns as stiffly as its linear spring does on a lever of 32 mm, about the reamer's size, mm^2.
/// Engineering choice.
constexpr double angular_per_linear_mm2 = 1000.0;

}  // namespace

void fit_to_device(const device::DeviceTraits& traits, double stiffness_n_mm, Settings& settings) {
  settings.stiffness_n_mm = stiffness_n_mm > 0.0 ? stiffness_n_mm : traits.stiffness_max_n_mm;
  settings.angular_stiffness_n_mm_rad =
      std::min(settings.stiffness_n_mm * angular_per_linear_mm2, traits.angular_stiffness_max_n_mm_rad);
  settings.limits = force::limits_for(traits.force_max_n, traits.torque_max_n_mm, settings.stiffness_n_mm,
                                      settings.angular_stiffness_n_mm_rad);
  settings.start_up_ramp_s = traits.start_up_ramp_s;
  settings.energy_guarded = traits.energy_guarded;
  settings.vibration.vibration_max_n = traits.vibration_max_n;
  settings.virtual_mass.reset();
  if (traits.causality == device::Causality::admittance)
    settings.virtual_mass.emplace().mass_kg = traits.effective_mass_kg;
}

}  // namespace ream::sim
