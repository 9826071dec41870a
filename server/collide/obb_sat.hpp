#pragma once
#include "geometry/box.hpp"

namespace ream::collide {

/// Separating-axis test of two oriented boxes given in one frame (15 axes; Gottschalk et al. 1996,
/// thesis 4.4). True when they touch or overlap; nearly parallel edges never separate by rounding.
bool overlap(const Obb& a, const Obb& b) noexcept;

}  // namespace ream::collide
