#pragma once
#include <memory>

#include "collide/removal.hpp"

namespace ream::collide {

/// A removal that may fail with bricks half cut, made to keep its promise: it remembers the listed bricks
/// before each cut and puts them back when `inner` failed. `bone` is the one that inner cuts.
std::unique_ptr<Removal> guarded(std::unique_ptr<Removal> inner, voxel::BoneModel& bone);

}  // namespace ream::collide
