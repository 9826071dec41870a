#pragma once
#include "sim/state.hpp"

namespace ream::sim {

/// Path, mm, that every probe of the tool may go from where it stands, in any direction, without meeting
/// bone: a lower bound from the distance field, 0 near bone. Removal only adds to it.
double clearance_mm(const Model& model, State& state) noexcept;

}  // namespace ream::sim
