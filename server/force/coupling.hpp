#pragma once
#include <array>

#include "force/wrench.hpp"
#include "geometry/pose.hpp"

namespace ream::force {

/// Six numbers in the tool frame at the tool's origin: linear part (mm or N), then angular part (rad or N
/// mm).
using Vec6 = std::array<double, 6>;
using Mat6 = std::array<double, 36>;  ///< row-major

/// Spring between handle and tool, in hand units; the force scale turns hand newtons into simulated ones.
struct CouplingParameters {
  double stiffness_n_mm = 2.0;  ///< hand side; a device's limit decides
  double angular_stiffness_n_mm_rad = 2000.0;
  double force_scale = 1.0;  ///< simulated N per hand N
  /// The spring yields beyond this, so that what cuts is what a device of limited force can let a hand feel.
  double stretch_max_mm = 1e9;
};

/// What resists the tool in one tick, tool frame, per unit of full axial contact.
struct Resistance {
  Mat6 cutting{};  ///< N s/mm, N s, N mm s: symmetric, positive semidefinite
  Mat6 guiding{};  ///< directions that are blocked outright (nipple, rim, standing spindle), any positive
                   ///< scale
  Vec3 outward = Vec3::Zero();  ///< mean outward normal of what is engaged, unit, or zero without contact
  /// What pulls the tool whether it moves or not: the lips' sideways force, N and N mm.
  Vec6 pull{};
};

struct CouplingStep {
  Vec6 tool_motion{};     ///< how the tool moves in this tick, tool frame
  Vec6 wrench_on_tool{};  ///< simulated N and N mm that the spring puts on the tool at the end of the tick
  bool yielded = false;   ///< the spring was stretched beyond its limit
};

/// One tick of the Maxwell element: the spring K between handle and tool in series with the
/// bone's feed law. Solves (B + K T) twist = K delta implicitly (backward Euler, passive for any B), where
/// `delta` is handle minus tool (mm, rad, tool frame). Never tensile, neither along the mean normal nor,
/// where bone lies ahead, along the axis: the part of delta that leaves the bone is followed without lag.
/// Deterministic: only + - x / in a fixed order.
CouplingStep couple(const CouplingParameters& parameters, const Resistance& resistance, const Vec6& delta,
                    double tick_s) noexcept;

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
  double friction = friction_coefficient;
};

/// Adds friction at the engaged surface to the resistance: across `outward` for sliding, about the axis for
/// turning. Friction has the size mu F whatever the speed and is opposed to the whole sliding velocity, so
/// that under a spinning cap its part along the surface is only the small share that the tool's own motion
/// has in that velocity; the spin's part is the spindle's affair. A symmetric, positive semidefinite matrix
/// that lags one tick: it only ever takes energy.
void add_friction(const Sliding& sliding, Resistance& resistance) noexcept;

/// What an admittance device lets the hand move where nothing is touched: a mass with a little damping, hand
/// side. Engineering choices, near the least that such devices render.
struct VirtualMass {
  double mass_kg = 2.0;
  double damping_n_s_mm = 0.01;
  double gyration_radius_mm = 50.0;  ///< the mass turns as if it were this far from the axis
};

/// Admittance is the coupling's own law with the mass in place of the spring: over one tick T a mass M that
/// bone with resistance B holds back obeys (B + M / T) twist = M / T (velocity + T F / M), which is
/// (B + K T) twist = K delta for K = M / T^2 and delta = where the mass would be at the tick's end if nothing
/// held it. This is that K, as a coupling's parameters.
CouplingParameters coupling_of(const VirtualMass& mass, double force_scale) noexcept;

/// That delta, mm and rad, tool frame: one tick of free flight under the hand's wrench (hand N and N mm, tool
/// frame, about the tool's origin) from the tool's twist (mm/s, rad/s). Damping is taken
/// implicitly; coupling_of() holds its other half.
Vec6 free_flight(const VirtualMass& mass, const Vec6& twist, const Wrench& hand) noexcept;

}  // namespace ream::force
