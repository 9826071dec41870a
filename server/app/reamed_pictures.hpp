#pragma once
#include <filesystem>
#include <vector>

#include "app/rig.hpp"
#include "render/snapshot.hpp"

namespace ream::app {

/// reamed.ply (world frame, mm) and snapshot.png (the glenoid seen along the plan's axis and a little from
/// above, freshly cut bone tinted) into `folder`. `before`: the coverage before the first tick.
void write_reamed_pictures(const Rig& rig, const std::vector<uint8_t>& before,
                           const std::filesystem::path& folder);

/// Where the picture is taken from: in front of the glenoid, off the axis, superior up.
render::Camera glenoid_camera(const case_::Plan& plan, const Vec3& superior, double distance_mm);

}  // namespace ream::app
