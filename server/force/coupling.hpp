#pragma once
#include <array>

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
};

struct CouplingStep {
  Vec6 tool_motion{};     ///< how the tool moves in this tick, tool frame
  Vec6 wrench_on_tool{};  ///< simulated N and N mm that the spring puts on the tool at the end of the tick
  bool yielded = false;   ///< the spring was stretched beyond its limit
};

/// One tick of the Maxwell element of DESIGN 3: the spring K between handle and tool in series with the
/// bone's feed law. Solves (B + K T) twist = K delta implicitly (backward Euler, passive for any B), where
/// `delta` is handle minus tool (mm, rad, tool frame). Never tensile, neither along the mean normal nor,
/// where bone lies ahead, along the axis: the part of delta that leaves the bone is followed without lag.
/// Deterministic: only + - x / in a fixed order.
CouplingStep couple(const CouplingParameters& parameters, const Resistance& resistance, const Vec6& delta,
                    double tick_s) noexcept;

}  // namespace ream::force
