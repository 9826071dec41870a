#pragma once
#include "geometry/pose.hpp"

namespace ream::openigtlink {

// OpenIGTLink and 3D Slicer have RAS: x to the patient's right, y to the front, z to the head; our world is
// LPS. Between them lies half a turn about z, so directions keep their handedness and rotations stay
// rotations. Both in mm.

/// Coordinates of the world, LPS, to RAS.
const Pose& ras_from_world();

/// Where something with a frame of its own (the tool) is.
Pose ras_from(const Pose& world_from_thing);

/// How something given in RAS has moved, of how it has moved in the world.
Pose moved_in_ras(const Pose& world_from_rest);

}  // namespace ream::openigtlink
