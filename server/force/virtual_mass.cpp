#include "force/virtual_mass.hpp"

#include "core/clock.hpp"

namespace ream::force {
namespace {

/// 1 N moves 1 kg with 1000 mm/s^2; likewise 1 N mm turns 1 kg mm^2 with 1000 rad/s^2.
constexpr double mm_s2_per_n_kg = 1000.0;

double inertia_kg_mm2(const VirtualMass& mass) {
  return mass.mass_kg * mass.gyration_radius_mm * mass.gyration_radius_mm;
}

double damping_gain(const VirtualMass& mass) {
  return tick_s * mm_s2_per_n_kg / mass.mass_kg * mass.damping_n_s_mm;
}

}  // namespace

CouplingParameters coupling_of(const VirtualMass& mass, double force_scale) noexcept {
  // Damping holds the mass back within the tick as free_flight takes it: it stiffens both alike.
  const double per_tick_squared = (1.0 + damping_gain(mass)) / (mm_s2_per_n_kg * tick_s * tick_s);
  return {mass.mass_kg * per_tick_squared, inertia_kg_mm2(mass) * per_tick_squared, force_scale};
}

Vec6 free_flight(const VirtualMass& mass, const Vec6& twist, const Wrench& hand) noexcept {
  const double linear_gain = tick_s * mm_s2_per_n_kg / mass.mass_kg;
  const double angular_gain = tick_s * mm_s2_per_n_kg / inertia_kg_mm2(mass);
  const double slowed = 1.0 / (1.0 + damping_gain(mass));
  Vec6 way{};
  for (size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    way[i] = tick_s * slowed * (twist[i] + linear_gain * hand.force_n[axis]);
    way[3 + i] = tick_s * slowed * (twist[3 + i] + angular_gain * hand.torque_n_mm[axis]);
  }
  return way;
}

}  // namespace ream::force
