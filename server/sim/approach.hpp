#pragma once
#include "sim/state.hpp"

namespace ream::sim {

/// Whether the tool touches bone where it stands, and what it touches there.
struct Approach {
  bool ok = true;  ///< false: the narrow phase failed
  collide::ContactSums sums;
};

/// Moves the free tool towards the handle until it touches or arrives. As far as the distance field promises
/// free space it goes without looking; beside bone it looks for contact after every `look_every_voxels`, and
/// where it finds some, goes back to where it began, to `touch_within_voxels`. What has been left behind
/// after `max_moves` is made up in later ticks, so a wall is met at any speed of the hand.
Approach approach(const Model& model, State& state, const Pose& world_from_handle) noexcept;

/// Upper bound of the path, mm, of any point of the tool while it goes from a to b as between() does. In
/// proportion to the fraction of the way.
double path_bound_mm(const Model& model, const Pose& world_from_a, const Pose& world_from_b) noexcept;

/// The pose a fraction 0..1 of the way from a to b.
Pose between(const Pose& world_from_a, const Pose& world_from_b, double fraction) noexcept;

/// Path of any point between two looks for contact, in voxels (smallest edge). A little less than one, so
/// that rounding never carries a point from one side of a voxel to the other.
inline constexpr double look_every_voxels = 15.0 / 16.0;

/// Path of any point from where the tool was last free to where it is found to touch, in voxels.
inline constexpr double touch_within_voxels = 1.0 / 32.0;

/// Moves in one tick. Beside bone 1 m/s and 10 rad/s need 18 of them where voxels are 0.08 mm.
inline constexpr int max_moves = 32;

}  // namespace ream::sim
