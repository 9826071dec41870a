#pragma once
#include <filesystem>
#include <vector>

#include "render/snapshot.hpp"
#include "session/simulation/simulation.hpp"

namespace ream::session {

/// reamed.ply (world frame, mm) and snapshot.png (the glenoid seen along the plan's axis and a little from
/// above, freshly cut bone tinted) into `folder`. `before`: the coverage before the first tick.
void write_reamed_pictures(const Simulation& simulation, const std::vector<uint8_t>& before,
                           const std::filesystem::path& folder);

/// The surface of the case's bone as it is, world frame, mm; one sample every `stride` voxels.
TriangleMesh reamed_surface(const case_::Case& bone_case, int stride = 1);

/// snapshot.png of such a case. `before`: the coverage before the first tick. `around`: what lies around the
/// bone, world frame, mm.
void write_picture(const case_::Case& bone_case, const std::vector<uint8_t>& before,
                   const std::filesystem::path& png, const TriangleMesh& around = {});

/// Where the picture is taken from: in front of the glenoid, off the axis, superior up.
render::Camera glenoid_camera(const case_::Plan& plan, const Vec3& superior, double distance_mm);

}  // namespace ream::session
