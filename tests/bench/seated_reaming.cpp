#include "bench/seated_reaming.hpp"

namespace ream::bench {

device::Script seated_script() {
  device::Script script;
  script.duration_s = 6.0;
  script.stiffness_n_mm = 100.0;
  script.hand.start_mm = Vec3(0, 0, -8.0);
  script.hand.force_profile = {{0.0, 10.0}, {0.5, 52.0}};
  return script;
}

sim::Settings seated_settings(const device::Script& script, const std::string& backend) {
  sim::Settings settings;
  settings.backend = backend;
  settings.tool_spacing_mm = 0.1;
  settings.stiffness_n_mm = script.stiffness_n_mm;
  settings.angular_stiffness_n_mm_rad = 1000.0 * script.stiffness_n_mm;
  settings.energy_guarded = false;
  return settings;
}

}  // namespace ream::bench
