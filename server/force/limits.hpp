#pragma once
#include "geometry/vec.hpp"

namespace ream::force {

/// What a device may be asked to render, hand side.
struct DeviceLimits {
  double force_max_n = 1e9;
  double torque_max_n_mm = 1e9;
};

/// `v` shortened to at most `limit`, direction kept.
Vec3 limited(const Vec3& v, double limit) noexcept;

}  // namespace ream::force
