#pragma once
#include <optional>

#include "device/scapula_mount.hpp"
#include "force/wrench.hpp"
#include "geometry/pose.hpp"

namespace ream::sim {

struct Model;
struct State;
struct ToolLoad;

/// Displacement of the bone from its rest: of the point of the planned entry, and about it; world frame.
struct MountState {
  Vec3 shift_mm = Vec3::Zero();
  Vec3 turn_rad = Vec3::Zero();  ///< rotation vector
};

/// The settings' mount with damping enough that the spring between handle and tool, which is sampled once a
/// tick, cannot shake the bone: it gives way by at most half of what the spring has left.
std::optional<device::ScapulaMount> stable_mount(const Model& model);

/// One tick (implicit Euler) of a mount under a force and its moment about the entry where it is now.
MountState settled_mount(const device::ScapulaMount& mount, const MountState& state,
                         const force::Wrench& about_entry, double tick_s) noexcept;

/// World from rest of a bone displaced about `point_mm` (world frame, at rest).
Pose displacement(const MountState& state, const Vec3& point_mm) noexcept;

/// Moves the bone under what the tool puts on it, directly and through the guide, and with it the tool when
/// that is `carried`. Does nothing where the bone is held rigidly.
void move_bone(const Model& model, State& state, const ToolLoad& load, bool carried) noexcept;

}  // namespace ream::sim
