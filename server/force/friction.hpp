#pragma once
#include "force/coupling.hpp"

namespace ream::force {

/// Coulomb friction of steel on wet bone. Engineering choice within the 0.1 to 0.3 that is reported for
/// lubricated contact.
inline constexpr double friction_coefficient = 0.2;

/// Sliding slower than this counts as sticking: the friction then acts as a stiff damper, mm/s. Engineering
/// choice: a reamer held against standing bone creeps at most this fast.
inline constexpr double sticking_speed_mm_s = 0.05;

/// How the engaged surface slides over bone.
struct Sliding {
  Vec3 point_mm = Vec3::Zero();   ///< where it lies, tool frame
  double normal_force_n = 0.0;    ///< simulated, of the tick before
  double along_speed_mm_s = 0.0;  ///< of that point across the contact normal, of the tick before
  double turn_speed_rad_s = 0.0;  ///< of the cutting surface about the tool's axis: spindle and handle
  double mean_radius_mm = 0.0;    ///< of the engaged surface about the tool's axis
};

/// Adds friction at the engaged surface to the resistance: across `outward` for sliding, about the axis for
/// turning. Friction has the size mu F whatever the speed and is opposed to the whole sliding velocity, so
/// that under a spinning cap its part along the surface is only the small share that the tool's own motion
/// has in that velocity; the spin's part is the spindle's affair. A symmetric, positive semidefinite matrix
/// that lags one tick: it only ever takes energy.
void add_friction(const Sliding& sliding, Resistance& resistance) noexcept;

}  // namespace ream::force
