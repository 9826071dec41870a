#pragma once
#include "sim/state.hpp"

namespace ream::sim {

/// Where the tool stands and what it touches there.
struct Approach {
  bool ok = true;  ///< false: the narrow phase's device failed
  collide::Voi voi;
  collide::ContactSums sums;
};

/// Moves the free tool towards the handle, at most one voxel between two looks for contact, until it touches
/// or arrives. What has been left behind beyond `max_substeps` voxels is made up in later ticks.
Approach approach(const Model& model, State& state, const Pose& world_from_handle) noexcept;

/// Contact of the tool as it stands.
Approach look(const Model& model, State& state) noexcept;

/// Upper bound of how far any point of the tool moves between two poses, mm.
double largest_motion_mm(const Model& model, const Pose& world_from_a, const Pose& world_from_b) noexcept;

/// The pose a fraction 0..1 of the way from a to b.
Pose between(const Pose& world_from_a, const Pose& world_from_b, double fraction) noexcept;

inline constexpr int max_substeps = 64;

}  // namespace ream::sim
