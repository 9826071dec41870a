#pragma once
#include "geometry/vec.hpp"

namespace ream::device {

/// How the scapula is held: a spring and a damper along and about each world axis (LPS) through the planned
/// entry point. It has no mass: damping x' + stiffness x = load.
struct ScapulaMount {
  Vec3 stiffness_n_mm = Vec3::Zero();  ///< above 0
  Vec3 damping_n_s_mm = Vec3::Zero();
  Vec3 angular_stiffness_n_mm_rad = Vec3::Zero();  ///< above 0
  Vec3 angular_damping_n_mm_s_rad = Vec3::Zero();
};

/// A scapula that muscles and the chest wall hold: 52 N moves it by 5 mm, 5 N m turn it by 5 degrees, each
/// with a time constant of 0.1 s. Engineering choice.
inline const ScapulaMount chest_wall_mount{Vec3::Constant(10.0), Vec3::Constant(1.0), Vec3::Constant(60.0e3),
                                           Vec3::Constant(6.0e3)};

}  // namespace ream::device
