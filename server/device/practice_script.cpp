#include <algorithm>
#include <cmath>

#include "device/profiles.hpp"
#include "device/script.hpp"

namespace ream::device {
namespace {

/// What a hand presses with when it presses hard, simulated N.
constexpr double hard_push_n = 80.0;

}  // namespace

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
