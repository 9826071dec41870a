#pragma once
#include <cstddef>
#include <vector>

#include "bench/validate/published.hpp"

namespace ream::bench {

/// The experiments as we repeat them (thesis 5.1). The thesis gives neither the ramp's length nor the
/// cortical depths: with ten seconds thrust rises over the way that its apparent stiffness speaks of.
inline constexpr double protocol_ramp_s = 10.0;
inline constexpr double cortical_depth_mm = 0.5, cancellous_depth_mm = 2.0;
/// Of the slab's cortical layer; what the first phase leaves of it is taken away before the second.
inline constexpr double cortical_layer_mm = 1.5;

/// One millisecond of a phase, from the moment that the tool touches.
struct ProtocolTick {
  double thrust_n = 0.0;
  double advance_mm = 0.0;  ///< since it touched
};

/// One phase of one specimen, up to the moment that the robot withdraws.
struct Phase {
  std::vector<ProtocolTick> ticks;
  double held_thrust_n = 0.0;  ///< mean while the full force is held
  double held_feed_mm_s = 0.0;
  /// Thrust gained per mm of the tool's advance while thrust first rises from the start threshold to 90 % of
  /// the full force.
  double stiffness_n_mm = 0.0;
};

struct SpecimenRun {
  Phase cortical, cancellous;
};

/// What the robot presses with while it holds its force.
struct PhaseForces {
  double cortical_n = published_thrust_n, cancellous_n = published_thrust_n;
};

/// Both phases of specimen `index` of table 5.1 on a slab with a cortical layer, with its own densities and
/// specimen factors, through the robot and the real tick.
SpecimenRun run_protocol(size_t index, const PhaseForces& forces = {});

}  // namespace ream::bench
