#pragma once

namespace ream::voxelizer {

inline double smaller(double a, double b) { return a < b ? a : b; }
inline double larger(double a, double b) { return a > b ? a : b; }
inline double magnitude(double a) { return a < 0.0 ? -a : a; }

/// ceil(x) and floor(x) held within [low, high], exact for every x and so the same whatever the limits.
inline int ceil_between(double x, int low, int high) {
  const double held = smaller(larger(x, static_cast<double>(low)), static_cast<double>(high));
  const int whole = static_cast<int>(held);
  return whole + static_cast<int>(static_cast<double>(whole) < held);
}
inline int floor_between(double x, int low, int high) {
  const double held = smaller(larger(x, static_cast<double>(low)), static_cast<double>(high));
  const int whole = static_cast<int>(held);
  return whole - static_cast<int>(static_cast<double>(whole) > held);
}

}  // namespace ream::voxelizer
