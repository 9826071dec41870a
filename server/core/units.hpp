#pragma once

namespace ream {

/// Inside the program angles are radians and spindle speed rad/s; degrees and rpm exist only at CLI, API and
/// UI.
inline constexpr double pi = 3.14159265358979323846;
inline constexpr double mm_per_m = 1000.0;
constexpr double radians_from_degrees(double degrees) { return degrees * (pi / 180.0); }
constexpr double degrees_from_radians(double radians) { return radians * (180.0 / pi); }
constexpr double rad_s_from_rpm(double rpm) { return rpm * (2.0 * pi / 60.0); }

}  // namespace ream
