#pragma once
#include "score/component.hpp"
#include "score/sphere_fit.hpp"

namespace ream::score {

/// A ray counts as reamed when so much of its face is gone (engineering judgement).
inline constexpr double reamed_mm = 0.05;

/// Whether a ray and all four beside it are reamed and still meet bone.
bool is_amid_reamed(const RayLattice& rays, const AchievedFace& face, size_t ray);

}  // namespace ream::score
