#include <algorithm>
#include <cmath>

#include "device/profiles.hpp"
#include "device/script/script.hpp"

namespace ream::device {
namespace {

/// What a hand presses with when it presses hard, simulated N.
constexpr double hard_push_n = 80.0;

}  // namespace

Script demo_script() {
  Script script;
  script.kind = ScriptKind::hand;
  script.duration_s = 28.5;
  script.force_scale = 1.0;
  script.stiffness_n_mm = 100.0;
  script.hand.start_mm = Vec3(0.0, 0.0, -12.0);
  // Approach, press harder, let go for a look, press again, withdraw: to the depth of the demo case's plan.
  script.hand.force_profile = {{0.0, 0.0},   {0.2, 8.0},   {2.0, 8.0},   {4.0, 52.0},
                               {14.0, 60.0}, {14.5, -8.0}, {15.5, -8.0}, {16.5, 30.0},
                               {17.5, 45.0}, {25.5, 45.0}, {26.0, -8.0}, {28.5, -8.0}};
  TimedButtons rinsed;
  rinsed.drive.irrigating = true;
  script.buttons = {rinsed};
  return script;
}

Script practice_script() {
  Script script;
  script.kind = ScriptKind::remote;
  script.device_profile = {};
  script.force_scale = 0.0;
  return script;
}

void fit_to_remote(const std::string& profile, Script& script) {
  const DeviceTraits traits = device_profile(profile);
  script.device_profile = profile;
  if (script.stiffness_n_mm > traits.stiffness_max_n_mm) script.stiffness_n_mm = 0.0;
  if (script.force_scale == 0.0)
    script.force_scale = std::max(1.0, std::ceil(hard_push_n / traits.force_max_n));
}

}  // namespace ream::device
