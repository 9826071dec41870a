#include "openigtlink/ras.hpp"

namespace ream::openigtlink {

const Pose& ras_from_world() {
  static const Pose half_turn{Vec3(-1.0, -1.0, 1.0).asDiagonal(), Vec3::Zero()};
  return half_turn;
}

Pose ras_from(const Pose& world_from_thing) { return ras_from_world() * world_from_thing; }

Pose moved_in_ras(const Pose& world_from_rest) {
  return ras_from_world() * world_from_rest * ras_from_world().inverse();
}

}  // namespace ream::openigtlink
