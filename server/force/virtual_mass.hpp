#pragma once
#include "force/coupling.hpp"
#include "force/wrench.hpp"

namespace ream::force {

/// What an admittance device lets the hand move where nothing is touched: a mass with a little damping, hand
/// side. Engineering choices, near the least that such devices render (science.md 1.2).
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
