#pragma once
#include <array>
#include <cstdint>

#include "geometry/vec.hpp"

namespace ream::surface {

/// Octahedral map of a direction (any length but zero) to two signed bytes, and back to a unit vector: the
/// octahedron |x| + |y| + |z| = 1 seen from +z, its lower half folded over the corners, -1..1 as -127..127.
/// Error below 1 degree.
std::array<int8_t, 2> octahedral_from_direction(const Vec3f& direction);
Vec3f direction_from_octahedral(int8_t ox, int8_t oy);

}  // namespace ream::surface
