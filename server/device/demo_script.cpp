#include "device/script.hpp"

namespace ream::device {

Script demo_script() {
  Script script;
  script.kind = ScriptKind::hand;
  script.duration_s = 37.5;
  script.force_scale = 1.0;
  script.stiffness_n_mm = 100.0;
  script.hand.start_mm = Vec3(0.0, 0.0, -12.0);
  // Approach, press harder, let go for a look, press again, withdraw.
  script.hand.force_profile = {{0.0, 0.0},   {0.2, 8.0},   {2.0, 8.0},   {4.0, 52.0},
                               {14.0, 60.0}, {14.5, -8.0}, {15.5, -8.0}, {16.5, 30.0},
                               {17.5, 75.0}, {34.5, 75.0}, {35.0, -8.0}, {37.5, -8.0}};
  return script;
}

}  // namespace ream::device
