#pragma once

namespace ream {

/// Inside the program angles are radians and spindle speed rad/s; degrees and rpm exist only at CLI, API and
/// UI.
inline constexpr double pi = 3.14159265358979323846;
inline constexpr double mm_per_m = 1000.0;
inline constexpr double standard_gravity_m_s2 = 9.80665;
inline constexpr double mm_s2_per_n_kg = 1000.0;          ///< acceleration of 1 kg under 1 N
inline constexpr double rad_s2_per_n_mm_kg_mm2 = 1000.0;  ///< angular acceleration of 1 kg mm^2 under 1 N mm
constexpr double radians_from_degrees(double degrees) { return degrees * (pi / 180.0); }
constexpr double degrees_from_radians(double radians) { return radians * (180.0 / pi); }
constexpr double rad_s_from_rpm(double rpm) { return rpm * (2.0 * pi / 60.0); }

}  // namespace ream
