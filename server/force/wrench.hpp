#pragma once
#include "geometry/vec.hpp"

namespace ream::force {

/// Force and moment together. Which frame, which point and which hand (simulated or felt) is said where one
/// is given.
struct Wrench {
  Vec3 force_n = Vec3::Zero();
  Vec3 torque_n_mm = Vec3::Zero();

  Wrench scaled(double by) const { return {by * force_n, by * torque_n_mm}; }
  bool is_zero() const { return force_n.isZero(0.0) && torque_n_mm.isZero(0.0); }
};

}  // namespace ream::force
