#include "device/profiles.hpp"

#include <array>

#include "core/error.hpp"
#include "core/units.hpp"

namespace ream::device {
namespace {

/// The table as its sources print it: N, N m, N/m, N s/m, m, kg. `mass_kg`: of an admittance device, its
/// virtual mass; of the others, what a hand shakes with the handle.
struct Published {
  const char* name;
  Causality causality;
  double force_n, torque_n_m, stiffness_n_m, damping_n_s_m, workspace_m;
  int sensed;
  double angular_stiffness_n_m_rad, mass_kg;
};

/// Without a published figure a device turns as stiffly as its linear spring does on a lever of this length.
/// Engineering choice.
constexpr double lever_squared_m2 = 1.0e-3;
constexpr double by_lever = 0.0;

constexpr Causality impedance = Causality::impedance, admittance = Causality::admittance;

/// What moves with a handle whose maker does not say it. Engineering choices: a parallel arm's and a drill's.
constexpr double parallel_arm_kg = 0.25, drill_kg = 1.2;
constexpr double stylus_kg = 0.045;

/// Rows without a note: CHAI3D 3 device table (continuous force, closed loop at 1 kHz). Mass of 3D Systems'
/// devices: apparent mass at the tip, from the maker's data sheets, not checked.
constexpr std::array<Published, 19> table{{
    {"omega.3", impedance, 12.0, 0.0, 5000.0, 30.0, 0.075, 3, by_lever, parallel_arm_kg},
    {"omega.6", impedance, 12.0, 0.0, 5000.0, 30.0, 0.075, 6, by_lever, parallel_arm_kg},
    {"omega.7", impedance, 12.0, 0.0, 5000.0, 30.0, 0.075, 7, by_lever, parallel_arm_kg},
    {"delta.3", impedance, 20.0, 0.0, 5000.0, 30.0, 0.15, 3, by_lever, parallel_arm_kg},
    {"sigma.7", impedance, 12.0, 0.2, 4000.0, 30.0, 0.075, 7, by_lever, parallel_arm_kg},
    {"lambda.7", impedance, 12.0, 0.2, 8000.0, 30.0, 0.1125, 7, by_lever, parallel_arm_kg},
    {"falcon", impedance, 8.0, 0.0, 3000.0, 20.0, 0.04, 3, by_lever, parallel_arm_kg},
    {"touch", impedance, 3.3, 0.0, 400.0, 4.0, 0.075, 6, by_lever, stylus_kg},
    {"phantom-omni", impedance, 3.3, 0.0, 700.0, 5.0, 0.10, 6, by_lever, stylus_kg},
    {"phantom-desktop", impedance, 7.9, 0.0, 1000.0, 5.0, 0.10, 6, by_lever, stylus_kg},
    {"premium-1.5-6dof", impedance, 8.5, 0.188, 800.0, 5.0, 0.12, 6, by_lever, 0.136},
    {"premium-3.0-6dof", impedance, 22.0, 0.188, 1000.0, 5.0, 0.25, 6, by_lever, 0.159},
    // Haply Inverse3: its public documents give neither force nor stiffness. Force as it is cut until one has
    // been measured; stiffness and damping as of the phantom-desktop, reach as of the phantom-omni.
    // Engineering choices.
    {"inverse3", impedance, 5.0, 0.0, 1000.0, 5.0, 0.10, 6, by_lever, parallel_arm_kg},
    // KUKA LBR iiwa in Cartesian impedance control: stiffness up to 5000 N/m and 300 N m/rad (libiiwa's
    // documentation); force is the payload's weight; torque of the wrist axes and reach from the maker's data
    // sheet, not checked; damping is critical (ratio 1, the control's upper end) with the payload as mass, 2
    // sqrt(K m).
    {"kuka-iiwa-7", impedance, 7.0 * standard_gravity_m_s2, 40.0, 5000.0, 374.0, 0.80, 6, 300.0, drill_kg},
    {"kuka-iiwa-14", impedance, 14.0 * standard_gravity_m_s2, 40.0, 5000.0, 529.0, 0.82, 6, 300.0, drill_kg},
    // HapticMaster (Van der Linde and others, EuroHaptics 2002): nominal force; the low end of 10 to 50 kN/m;
    // smallest tip mass; half of the arm's 0.36 m stroke. Not checked against the paper.
    {"hapticmaster", admittance, 100.0, 0.0, 10000.0, 0.0, 0.18, 3, by_lever, 2.0},
    // An arm of the same kind, position-controlled, with a force sensor at its flange: payload's weight as
    // force; the virtual mass is what its delay lets feel steady in a hand. Engineering choice.
    {"robot-force-mode", admittance, 14.0 * standard_gravity_m_s2, 40.0, 5000.0, 0.0, 0.40, 6, 300.0, 10.0},
    // No device: far beyond what a hand does, for scripts that study the simulation and not a device.
    {"ideal", impedance, 1000.0, 100.0, 100000.0, 1.0e6, 10.0, 6, by_lever, stylus_kg},
    {"ideal-admittance", admittance, 1000.0, 100.0, 100000.0, 1.0e6, 10.0, 6, by_lever, 1.0},
}};

/// Makers let force rise over this long once the handle is held (CHAI3D's cGenericTool).
constexpr double default_ramp_s = 2.0;
/// Of the continuous force, what drill vibration on top of contact stays within: contact is still felt while
/// it shakes. Engineering choice.
constexpr double vibration_share = 0.25;

DeviceTraits traits_of(const Published& row) {
  const std::string name = row.name;
  const bool ideal = name.starts_with("ideal");
  const double angular_n_m_rad = row.angular_stiffness_n_m_rad > 0.0 ? row.angular_stiffness_n_m_rad
                                                                     : row.stiffness_n_m * lever_squared_m2;
  DeviceTraits traits;
  traits.name = traits.profile = name;
  traits.causality = row.causality;
  traits.force_max_n = row.force_n;
  traits.torque_max_n_mm = row.torque_n_m * mm_per_m;
  traits.stiffness_max_n_mm = row.stiffness_n_m / mm_per_m;
  traits.angular_stiffness_max_n_mm_rad = angular_n_m_rad * mm_per_m;
  traits.damping_max_n_s_mm = row.damping_n_s_m / mm_per_m;
  traits.workspace_radius_mm = row.workspace_m * mm_per_m;
  traits.start_up_ramp_s = ideal ? 0.0 : default_ramp_s;
  traits.vibration_max_n = vibration_share * row.force_n;
  traits.energy_guarded = !ideal;
  (row.causality == admittance ? traits.effective_mass_kg : traits.handle_mass_kg) = row.mass_kg;
  traits.degrees_of_freedom = row.sensed;
  return traits;
}

/// Of plug-ins.
std::vector<DeviceTraits>& more_profiles() {
  static std::vector<DeviceTraits> profiles;
  return profiles;
}

}  // namespace

DeviceTraits device_profile(const std::string& name) {
  std::string names;
  for (const Published& row : table) {
    if (name == row.name) return traits_of(row);
    names += (names.empty() ? "" : ", ") + std::string(row.name);
  }
  for (const DeviceTraits& traits : more_profiles()) {
    if (name == traits.name) return traits;
    names += ", " + traits.name;
  }
  throw Error(ErrorKind::invalid_input, "no device profile '" + name + "'; there are " + names);
}

std::vector<std::string> device_profile_names() {
  std::vector<std::string> names;
  for (const Published& row : table) names.emplace_back(row.name);
  for (const DeviceTraits& traits : more_profiles()) names.push_back(traits.name);
  return names;
}

void add_device_profile(DeviceTraits traits) {
  for (const std::string& name : device_profile_names())
    if (name == traits.name)
      throw Error(ErrorKind::conflict,
                  "there is a device profile '" + name + "' already; choose another name");
  traits.profile = traits.name;
  traits.angular_stiffness_max_n_mm_rad = traits.stiffness_max_n_mm * lever_squared_m2 * mm_per_m * mm_per_m;
  traits.start_up_ramp_s = default_ramp_s;
  traits.vibration_max_n = vibration_share * traits.force_max_n;
  more_profiles().push_back(std::move(traits));
}

const char* device_axes(const std::string& device) {
  if (device == "haply") return "x,z,-y";          // y away from the person, z up
  if (device == "forcedimension") return "y,z,x";  // x towards the person, z up
  return "x,y,z";                                  // the person's own, as 3D Systems' devices
}

}  // namespace ream::device
