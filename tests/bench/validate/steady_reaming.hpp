#pragma once
#include "device/script/script.hpp"
#include "support/small_run.hpp"

namespace ream::bench {

/// Height of the surface of every slab of this suite, mm, grid frame.
inline constexpr double slab_surface_mm = 9.0;
/// Reamer of this suite: a cap small enough to lie in the slab with all of its engaged surface.
inline constexpr const char* slab_reamer = "sphere 8,5";

/// A slab of one density, ready to be reamed at its middle as `script` says.
test::SmallRun slab_run(double density_g_cc, const device::Script& script);

struct SteadyReaming {
  double feed_mm_s = 0.0;       ///< of the tool over the last second
  double thrust_n = 0.0;        ///< simulated, mean over it
  double ripple_percent = 0.0;  ///< of the hand force over it: largest less smallest, over the mean
};

/// A hand that presses with a constant simulated force for three seconds, through the real tick.
SteadyReaming steady_reaming(double density_g_cc, double force_n, double specimen_factor = 1.0,
                             const char* device_profile = "ideal");

/// Depth of the tool's apex in the plan frame, mm.
double apex_mm(const sim::Model& model, const record::TickReport& report);

}  // namespace ream::bench
